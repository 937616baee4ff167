// Tables of synthetic leaves in the forms of four instruments. The leaf is written once more by the formulae of the
// papers, so that nothing of the program is tested with itself.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace leaf_files {

struct TrueLeaf {
    double v = 62, jmax = 118, rd = 1.3, g0 = 0.005, g1 = 3.4, absorptance = 0.85;
};

/// In SI-like units: umol, mol, kPa, degrees Celsius.
struct Row {
    double incident, absorbed, ci, temperature, pressure, deficit, a, gs, e, ca;
};

inline double arrhenius(double k25, double ha, double celsius) {
    const double kelvin = celsius + 273.15;
    return k25 * std::exp(ha * (kelvin - 298.15) / (298.15 * 8.314462618 * kelvin));
}

/// Farquhar et al. (1980) with the constants of Bernacchi et al. (2001).
inline double assimilation(const TrueLeaf& leaf, double absorbed, double ci, double celsius, double pressure) {
    const double sea = 101.325 / pressure;
    const double gamma = arrhenius(42.75, 37830, celsius) * sea;
    const double km = arrhenius(404.9, 79430, celsius) * (1 + 210 / arrhenius(278.4, 36380, celsius)) * sea;
    const double jmax = arrhenius(leaf.jmax, 43540, celsius), b = 0.24 * absorbed + jmax;
    const double j = (b - std::sqrt(b * b - 4 * 0.85 * 0.24 * absorbed * jmax)) / (2 * 0.85);
    const double c = arrhenius(leaf.v, 65330, celsius) * (ci - gamma) / (ci + km);
    return std::min(c, j / 4 * (ci - gamma) / (ci + 2 * gamma)) - arrhenius(leaf.rd, 46390, celsius);
}

/// A curve over Ci in strong light, one over light, and a leaf in the dark.
inline std::vector<Row> measured(const TrueLeaf& leaf) {
    std::vector<Row> rows;
    const auto add = [&](double incident, double ci, double celsius, double deficit) {
        Row row{incident, leaf.absorptance * incident, ci, celsius, 99.2, deficit, 0, leaf.g0, 0, 0};
        row.a = assimilation(leaf, row.absorbed, ci, celsius, row.pressure);
        // Cs = Ci + 1.6 A / gs and gs = g0 + 1.6 (1 + g1 / sqrt(D)) A / Cs hold at once: by iteration.
        row.ca = ci;
        for (int k = 0; k < 200 && row.a > 0; ++k) {
            row.gs = leaf.g0 + 1.6 * (1 + leaf.g1 / std::sqrt(deficit)) * row.a / row.ca;
            row.ca = 0.5 * row.ca + 0.5 * (ci + 1.6 * row.a / row.gs);
        }
        row.e = row.gs * deficit / row.pressure;
        rows.push_back(row);
    };
    for (const double ci : {60.0, 110.0, 170.0, 240.0, 320.0, 450.0, 650.0, 900.0, 1300.0}) add(1800, ci, 26, 1.1);
    for (const double light : {1200.0, 700.0, 400.0, 200.0, 90.0, 0.0}) add(light, 290, 24.5, 1.6);
    return rows;
}

inline std::string li6400(const std::vector<Row>& rows) {
    std::string text =
        "\"OPEN 6.1.4\"\n\"Thr Jun 4 2015 10:31:02\"\n\"Unit=\"\t\"PSC-1\"\n\"$STARTOFDATA$\"\n"
        "\"Obs\"\t\"HHMMSS\"\t\"FTime\"\t\"Photo\"\t\"Cond\"\t\"Ci\"\t\"Trmmol\"\t\"VpdL\"\t\"Tleaf\"\t\"PARi\"\t\"Pres"
        "s\""
        "\t\"CO2S\"\n";
    int obs = 0;
    for (const Row& row : rows) {
        if (obs == 3) text += "\"10:44:39 Coolers: Tblock -> 28.00 C\"\n";
        ++obs;
        text += fmt::format("{}\t\"10:4{}:12\"\t{}\t{:.6g}\t{:.6g}\t{:.6g}\t{:.6g}\t{:.6g}\t{}\t{}\t{}\t{:.6g}\n", obs,
                            obs % 10, 60.5 * obs, row.a, row.gs, row.ci, 1000 * row.e, row.deficit, row.temperature,
                            row.incident, row.pressure, row.ca);
    }
    return text;
}

inline std::string li6800(const std::vector<Row>& rows) {
    std::string text =
        "[Header]\nSysConst:AvgTime\t4\nFile opened\t2024-05-02 09:12:44\n[Data]\n"
        "Sys\tSys\tSys\tGasEx\tGasEx\tGasEx\tGasEx\tGasEx\tGasEx\tGasEx\tGasEx\tMeas\tMeas\tLeafQ\tLeafQ\n"
        "obs\ttime\tTIME\tTIME\tE\tA\tCa\tCi\tgsw\tTleaf\tVPDleaf\tPa\tTleaf2\tQin\tQabs\n"
        "\ts\thh:mm:ss\ts\tmol m\u207b\u00b2 s\u207b\u00b9\t\u00b5mol m\u207b\u00b2 s\u207b\u00b9\t\u00b5mol "
        "mol\u207b\u00b9\t\u00b5mol mol\u207b\u00b9\tmol m\u207b\u00b2 "
        "s\u207b\u00b9\t\u00b0C\tkPa\tkPa\t\u00b0C\t\u00b5mol m\u207b\u00b2 s\u207b\u00b9\t\u00b5mol m\u207b\u00b2 "
        "s\u207b\u00b9\n";
    int obs = 0;
    for (const Row& row : rows) {
        ++obs;
        text +=
            fmt::format("{}\t{}\t09:20:00\t{}\t{:.6g}\t{:.6g}\t{:.6g}\t{:.6g}\t{:.6g}\t{}\t{}\t{}\t999.9\t{}\t{:.6g}\n",
                        obs, 60 * obs, 60 * obs, row.e, row.a, row.ca, row.ci, row.gs, row.temperature, row.deficit,
                        row.pressure, row.incident, row.absorbed);
    }
    return text;
}

/// Latin-1: the letter of micro is one byte.
inline std::string gfs3000(const std::vector<Row>& rows) {
    std::string text =
        "Date;Time;Code;Object;Pamb;PARtop;Tleaf;VPD;GH2O;E;A;ca;ci;Yield\n"
        "yyyy-mm-dd;hh:mm:ss;;;kPa;\xB5mol m-2 s-1;\xB0"
        "C;Pa/kPa;mmol m-2 s-1;mmol m-2 s-1;\xB5mol m-2 s-1;ppm;ppm;\n"
        "2023-07-01;08:00:01;ZPi001;1;99.2;0;22;0;0;0;;400;;\n";
    int obs = 0;
    for (const Row& row : rows) {
        text += fmt::format("2023-07-01;08:{:02}:01;MP_{:03};1;{};{};{};{:.6g};{:.6g};{:.6g};{:.6g};{:.6g};{:.6g};\n",
                            obs, obs, row.pressure, row.incident, row.temperature, 1000 * row.deficit / row.pressure,
                            1000 * row.gs, 1000 * row.e, row.a, row.ca, row.ci);
        ++obs;
    }
    return text;
}

inline std::string ciras4(const std::vector<Row>& rows, const std::string& gs = "gs", double factor_of_gs = 1000) {
    std::string text = "Plot, Date, Time, CO2r, CO2a, Patm, PARi, Tleaf, Ci, " + gs + ", VPD, A, E\n";
    int obs = 0;
    for (const Row& row : rows) {
        text += fmt::format(
            "{}, 01/07/2023, 08:{:02}:00, 420, {:.6g}, {:.6g}, {}, {}, {:.6g}, {:.6g}, {}, {:.6g}, {:.6g}\n", 1, obs++,
            row.ca, 10 * row.pressure, row.incident, row.temperature, row.ci, factor_of_gs * row.gs, row.deficit, row.a,
            1000 * row.e);
    }
    return text;
}

}  // namespace leaf_files
