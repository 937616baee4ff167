// fit-leaf: parameters of leaf-exchange from the table of an instrument for gas exchange.
#include "espalier/base/error.h"
#include "espalier/picture/chart_page.h"

#include "app/command.h"
#include "app/options.h"
#include "base/json_text.h"
#include "environment/leaf/gas/settings.h"
#include "picture_options.h"
#include "study/fit/leaf_fit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;
using namespace environment::leaf;

/// The table of a leaf-exchange with these keys.
LeafKind leaf_with(const std::vector<std::string>& sets) {
    Settings table;
    for (const std::string& text : sets) {
        const auto [key, value] = key_and_value(text, "--set");
        table.set(key, value);
    }
    const LeafKind leaf = read_leaf_kind(table);
    table.reject_unread();
    return leaf;
}

/// Rows by what lies along x.
Series dots(std::size_t key, const LeafRecords& records, double LeafRecord::*along,
            const std::function<double(const LeafRecord&)>& up) {
    Series series{key, {}, {}, {}, {}, false};
    for (const LeafRecord& row : records.rows) {
        series.x.push_back(row.*along);
        series.y.push_back(up(row));
    }
    return series;
}

class FitLeaf final : public Command {
public:
    explicit FitLeaf(CLI::App& program)
        : Command(program, "fit-leaf", "find parameters of a leaf from measured gas exchange"), picture_(app()) {
        app().add_option("table", table_, "the table of a LI-6400, LI-6800, GFS-3000 or CIRAS-4, as text")->required();
        app()
            .add_option("--parameter", names_,
                        "what is fitted, keys of leaf-exchange: v, jmax, rd, tpu, g0, g1, and vp of C4; default: v, vp "
                        "(C4), jmax, rd, g1")
            ->delimiter(',')
            ->allow_extra_args(false);
        app()
            .add_option("--set", sets_,
                        "KEY=VALUE of leaf-exchange that is not fitted, as pathway=c4 or g0=0.01; may be repeated")
            ->allow_extra_args(false);
        app()
            .add_option("--absorptance", choices_.absorptance,
                        "share of PAR that the leaf absorbs, where the instrument does not say")
            ->check(CLI::Range(0.01, 1.0))
            ->capture_default_str();
        app().add_option("--output", output_, "draw the measured and the fitted leaf into this .png or .svg");
        add_json_flag("print the result as JSON");
        app().footer(
            R"(The instrument is told by the names of the columns. Photosynthesis (v, jmax, rd, tpu) is fitted to the assimilation at the Ci, light
and temperature of each row; stomata (g0, g1) to the conductance of the rows that gain. Parameters are those at 25
degrees, and what is printed last are lines for a scene.
Examples:
  espalier fit-leaf aci.txt --output aci.png
  espalier fit-leaf maize.csv --set pathway=c4 --parameter v,vp,rd)");
    }

    int run() override {
        choices_.leaf = leaf_with(sets_);
        choices_.fitted = names_;
        if (names_.empty()) {
            choices_.fitted = choices_.leaf.photosynthesis.pathway == Pathway::c4
                                  ? std::vector<std::string>{"v", "vp", "jmax", "rd", "g1"}
                                  : std::vector<std::string>{"v", "jmax", "rd", "g1"};
        }
        const LeafRecords records = read_leaf_records(table_);
        const study::LeafFit fit = study::fit_leaf(records, choices_);
        if (!output_.empty()) {
            const ChartPage page = page_of(records, fit);
            write_picture(page, picture_.size(fitting_size(page)), output_);
        }
        wants_json() ? print_json(records, fit) : print(records, fit);
        return exit_code::done;
    }

private:
    ChartPage page_of(const LeafRecords& records, const study::LeafFit& fit) const {
        ChartPage page;
        page.title = fmt::format("{}, {}", table_.filename().string(), records.instrument);
        page.keys = {{"measured", 0, 0}, {"fitted", 1, 0}};
        page.dark = picture_.dark();
        const auto modelled = [&](const LeafRecord& row) {
            return study::modelled_assimilation(row, choices_, fit.leaf);
        };
        const auto measured = [](const LeafRecord& row) { return row.assimilation; };
        const std::string rate = "assimilation (umol m-2 s-1)";
        for (const auto& [along, title] : {std::pair{&LeafRecord::internal, "Ci (umol/mol)"},
                                           std::pair{&LeafRecord::incident, "PAR (umol m-2 s-1)"}}) {
            page.charts.push_back(
                {title, rate, {dots(0, records, along, measured), dots(1, records, along, modelled)}});
        }
        if (fit.rows_of_conductance > 0) {
            const auto opened = [&](const LeafRecord& row) { return study::modelled_conductance(row, fit.leaf); };
            const auto open = [](const LeafRecord& row) { return row.conductance; };
            page.charts.push_back({rate,
                                   "conductance (mol m-2 s-1)",
                                   {dots(0, records, &LeafRecord::assimilation, open),
                                    dots(1, records, &LeafRecord::assimilation, opened)}});
        }
        return page;
    }

    void print_json(const LeafRecords& records, const study::LeafFit& fit) const {
        nlohmann::ordered_json json = {{"instrument", records.instrument},
                                       {"rows", records.rows.size()},
                                       {"left_out", records.left_out},
                                       {"limits", fit.limits},
                                       {"residual_assimilation", fit.residual_of_assimilation},
                                       {"residual_conductance", fit.residual_of_conductance}};
        for (const study::FittedNumber& one : fit.numbers) {
            json["parameters"][one.name] = {{"value", one.value}, {"error", one.error}};
        }
        json["confused"] = nlohmann::ordered_json::array();
        for (const study::ConfusedPair& pair : fit.pairs) {
            json["confused"].push_back({{"pair", {pair.first, pair.second}}, {"correlation", pair.correlation}});
        }
        fmt::print("{}\n", json_text(json));
    }

    void print(const LeafRecords& records, const study::LeafFit& fit) const {
        fmt::print("{}, {} rows", records.instrument, records.rows.size());
        if (records.left_out > 0) fmt::print("; {} left out: {}", records.left_out, records.why);
        fmt::print("\n");
        std::vector<std::string> limits;
        for (const auto& [limit, rows] : fit.limits) limits.push_back(fmt::format("{} by {}", rows, limit));
        if (!limits.empty()) fmt::print("limited: {}\n", fmt::join(limits, ", "));
        if (fit.rows_of_assimilation > 0) {
            fmt::print("assimilation: within {:.3g} umol m-2 s-1 in {} rows\n", fit.residual_of_assimilation,
                       fit.rows_of_assimilation);
        }
        if (fit.rows_of_conductance > 0) {
            fmt::print("conductance: within {:.3g} mol m-2 s-1 in {} rows\n", fit.residual_of_conductance,
                       fit.rows_of_conductance);
        }
        print_doubts(fit);
        fmt::print("\n");
        for (const study::FittedNumber& one : fit.numbers) {
            const std::string error = is_decided(one) ? fmt::format("+- {:.2g}", one.error) : "not decided";
            fmt::print("{:<4} = {:<10.5g} # {}{}{}\n", one.name, one.value, error, one.unit.empty() ? "" : " ",
                       one.unit);
        }
    }

    static bool is_decided(const study::FittedNumber& one) { return one.error < 10 * std::abs(one.value); }

    void print_doubts(const study::LeafFit& fit) const {
        for (const study::FittedNumber& one : fit.numbers) {
            const bool is_in_pair = std::any_of(
                fit.pairs.begin(), fit.pairs.end(),
                [&](const study::ConfusedPair& pair) { return pair.first == one.name || pair.second == one.name; });
            if (is_decided(one) || is_in_pair) continue;
            fmt::print("{}: the table does not decide it{}\n", one.name,
                       one.name == "jmax" && !fit.limits.contains("light")
                           ? ", as no row is limited by light: measure at higher Ci, or leave it out"
                           : "");
        }
        for (const study::ConfusedPair& pair : fit.pairs) {
            fmt::print(
                "{0} and {1} cannot be told apart (correlation {2:.3f}): more of {0} with {3} of {1} fits as well; "
                "give "
                "one of them with --set, or measure {4}\n",
                pair.first, pair.second, pair.correlation, pair.correlation > 0 ? "more" : "less",
                pair.second == "rd" ? "in the dark or in dim light" : "over a wider range of Ci, light or air");
        }
        const bool wants_stomata = std::any_of(choices_.fitted.begin(), choices_.fitted.end(),
                                               [](const std::string& name) { return name.starts_with("g"); });
        if (wants_stomata && fit.rows_of_conductance == 0) {
            fmt::print("stomata: too few rows tell a conductance and a vapour deficit while the leaf gains\n");
        }
    }

    PictureOptions picture_;
    fs::path table_, output_;
    std::vector<std::string> names_, sets_;
    study::LeafFitChoices choices_;
};

const RegisteredCommand<FitLeaf> fit_leaf_entry{46};

}  // namespace
}  // namespace espalier::app
