// Multiscale tree graphs (Godin and Caraglio 1998) as OpenAlea reads them: plants P, axes A, internodes I.
#include "espalier/base/file.h"
#include "espalier/formats/exporter.h"

#include "archive/meshes/axis_tree.h"
#include "archive/meshes/surface_mesh.h"
#include "base/text.h"
#include "formats/map_place.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <iterator>

namespace espalier::formats {
namespace {

constexpr std::string_view features = "plant\torder\tbirth\tlength\tdiameter\tXX\tYY\tZZ\tidentity";

class MtgText {
public:
    MtgText(const ExportJob& job, const AxisTree& tree) : job_(job), tree_(tree), column_of_(columns()) {}

    std::string text() {
        add_head();
        int number = 0;
        for (const AxisIndex trunk : tree_.trunks()) {
            prefix_ = fmt::format("/P{}", ++number);
            add_with_laterals(trunk);
        }
        return std::move(text_);
    }

private:
    using AxisIndex = AxisTree::AxisIndex;
    using Columns = RowsOf<AxisTree::Axis, std::uint32_t>;

    bool follows(AxisIndex number) const { return tree_.axes[number].goes_on; }

    // Each axis stands one column to the right of what bears it, unless it goes on. What bears it may be drawn later.
    Columns columns() {
        constexpr std::uint32_t unknown = 0xFFFFFFFF;
        RowsOf<FrameInternode, AxisIndex> axis_of(tree_.internodes.size());
        for (AxisIndex number(0); number < tree_.axes.next(); ++number) {
            const AxisTree::Axis& axis = tree_.axes[number];
            for (InternodeIndex i = axis.first; i < axis.end; ++i) axis_of[i] = number;
        }
        Columns of_axis(tree_.axes.size(), unknown);
        std::vector<AxisIndex> path;
        for (AxisIndex number(0); number < tree_.axes.next(); ++number) {
            path.assign(1, number);
            while (of_axis[path.back()] == unknown && !tree_.axes[path.back()].bearer.is_none()) {
                path.push_back(axis_of[tree_.axes[path.back()].bearer]);
            }
            if (of_axis[path.back()] == unknown) of_axis[path.back()] = 0;
            for (std::size_t k = path.size() - 1; k-- > 0;) {
                of_axis[path[k]] = of_axis[path[k + 1]] + (follows(path[k]) ? 0 : 1);
            }
        }
        return of_axis;
    }

    // Those that go on come last, because the column is theirs from there on.
    std::vector<AxisIndex> borne_by(InternodeIndex internode) const {
        std::vector<AxisIndex> borne = tree_.axes_borne[internode];
        std::stable_partition(borne.begin(), borne.end(), [&](AxisIndex axis) { return !follows(axis); });
        return borne;
    }

    template <class... Values>
    void put(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    }

    void add_head() {
        width_ = column_of_.empty() ? 1 : *std::max_element(column_of_.begin(), column_of_.end()) + 1;
        put("# unit: m\n# up: {}\n{}", job_.options.up, origin_line("# ", job_.run, job_.options.up));
        put("CODE:\tFORM-A\n\nCLASSES:\nSYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION\n"
            "$\t0\tFREE\tFREE\tIMPLICIT\nP\t1\tFREE\tFREE\tEXPLICIT\nA\t2\tFREE\tFREE\tEXPLICIT\n"
            "I\t3\tFREE\tFREE\tEXPLICIT\n\nDESCRIPTION:\nLEFT\tRIGHT\tRELTYPE\tMAX\n"
            "A\tA\t+\t?\nI\tI\t+\t?\nI\tI\t<\t?\n\nFEATURES:\nNAME\tTYPE\n"
            "plant\tALPHA\norder\tINT\nbirth\tINT\nlength\tREAL\ndiameter\tREAL\nXX\tREAL\nYY\tREAL\nZZ\tREAL\n"
            "identity\tALPHA\n\nMTG:\nENTITY-CODE{}{}\n",
            std::string(width_, '\t'), features);
    }

    // What an internode bears stands below it, before its successor; any number of orders, so no recursion.
    void add_with_laterals(AxisIndex trunk) {
        struct Open {
            AxisIndex axis;
            InternodeIndex internode;
            std::vector<AxisIndex> borne;
            std::size_t lateral = 0;
        };
        std::vector<Open> open;
        const auto begin = [&](AxisIndex axis) {
            const InternodeIndex first = tree_.axes[axis].first;
            add_axis(axis);
            add_internode(axis, first);
            open.push_back({axis, first, borne_by(first)});
        };
        begin(trunk);
        while (!open.empty()) {
            Open& top = open.back();
            if (top.lateral < top.borne.size()) {
                begin(top.borne[top.lateral++]);
            } else if (top.internode.next() < tree_.axes[top.axis].end) {
                ++top.internode;
                top.borne = borne_by(top.internode);
                top.lateral = 0;
                add_internode(top.axis, top.internode);
            } else {
                open.pop_back();
            }
        }
    }

    bool begins_at_tip(const AxisTree::Axis& axis) const {
        return !axis.bearer.is_none() && tree_.internodes[axis.first].base == tree_.internodes[axis.bearer].tip;
    }

    std::string code_of(AxisIndex number) const {
        const bool is_trunk = tree_.axes[number].bearer.is_none();
        return fmt::format("{}A{}", is_trunk ? prefix_ + "/" : follows(number) ? "^<" : "+", number.number + 1);
    }

    // An axis that does not begin at the tip of what bears it has a row, which holds where it begins.
    void add_axis(AxisIndex number) {
        const AxisTree::Axis& axis = tree_.axes[number];
        if (begins_at_tip(axis)) return;
        const FrameInternode& first = tree_.internodes[axis.first];
        const glm::vec3 base = upright(first.base, job_.options.up);
        add_code(number, code_of(number));
        put("{}\t{}\t{}\t\t\t{}\t{}\t{}\t\n", plant_name(axis.plant), first.order, first.birth, base.x, base.y, base.z);
    }

    void add_code(AxisIndex axis, const std::string& code) {
        const std::uint32_t column = column_of_[axis];
        text_.append(column, '\t').append(code).append(width_ - column, '\t');
    }

    std::string code_of(AxisIndex number, InternodeIndex internode) const {
        const AxisTree::Axis& axis = tree_.axes[number];
        if (internode > axis.first) return fmt::format("^<I{}", internode.number + 1);
        return fmt::format("{}/I{}", begins_at_tip(axis) ? code_of(number) : "^", internode.number + 1);
    }

    void add_internode(AxisIndex axis, InternodeIndex number) {
        const FrameInternode& internode = tree_.internodes[number];
        const glm::vec3 tip = upright(internode.tip, job_.options.up);
        add_code(axis, code_of(axis, number));
        put("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", plant_name(internode.plant), internode.order, internode.birth,
            glm::distance(internode.base, internode.tip), internode.base_radius + internode.tip_radius, tip.x, tip.y,
            tip.z, internode.identity);
    }

    // Tabs and line breaks part cells and rows.
    std::string plant_name(std::uint32_t plant) const {
        std::string name = job_.run.plants()[plant].name;
        std::replace_if(
            name.begin(), name.end(), [](char c) { return c == '\t' || c == '\n' || c == ' '; }, '_');
        return name;
    }

    const ExportJob& job_;
    const AxisTree& tree_;
    Columns column_of_;
    std::size_t width_ = 1;
    std::string prefix_;
    std::string text_;
};

class Mtg final : public Exporter {
public:
    std::string extension() const override { return "mtg"; }

    void write(const ExportJob& job) const override {
        for (const RecordedFrame* frame : job.frames) {
            AxisTree tree = axis_tree(job.run.geometry(*frame), job.options);
            settle_bearers(tree);
            const auto path = job.path(*frame, extension());
            write_text(path, MtgText(job, tree).text());
            job.report({path, 0, 0, tree.internodes.size(), "internodes"});
        }
    }
};

const Registered<ExporterType> entry{
    {"mtg", "multiscale tree graph, a file per frame: for OpenAlea",
     "Scales plant P, axis A, internode I; < follows, + is borne by. Features: plant, order, birth, length, diameter\n"
     "(in the middle), XX YY ZZ (of the tip), identity. Trunks, and axes that begin beside what bears them or behind a "
     "gap, have\n"
     "a row of their own, whose XX YY ZZ are where they begin. Axes that stand on nothing begin a P of their own.\n"
     "Lost: organs and surfaces, parameters",
     construct<Mtg>}};

}  // namespace
}  // namespace espalier::formats
