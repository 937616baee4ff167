// Multiscale tree graphs (Godin and Caraglio 1998) as OpenAlea reads them: plants P, axes A, internodes I.
#include "espalier/base/file.h"
#include "espalier/formats/exporter.h"

#include "archive/meshes/axis_tree.h"
#include "archive/meshes/surface_mesh.h"
#include "base/text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <iterator>

namespace espalier::formats {
namespace {

constexpr std::string_view features = "plant\torder\tbirth\tlength\tdiameter\tXX\tYY\tZZ\tidentity";

class MtgText {
public:
    MtgText(const ExportJob& job, const AxisTree& tree) : job_(job), tree_(tree), column_of_(columns(tree)) {}

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

    // Each axis stands one column to the right of what bears it.
    static Columns columns(const AxisTree& tree) {
        Columns of_axis;
        RowsOf<FrameInternode, std::uint32_t> of_internode(tree.internodes.size());
        for (const AxisTree::Axis& axis : tree.axes) {
            of_axis.push_back(axis.bearer.is_none() ? 0 : of_internode[axis.bearer] + 1);
            for (InternodeIndex i = axis.first; i < axis.end; ++i) of_internode[i] = of_axis.back();
        }
        return of_axis;
    }

    template <class... Values>
    void put(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    }

    void add_head() {
        width_ = column_of_.empty() ? 1 : *std::max_element(column_of_.begin(), column_of_.end()) + 1;
        put("# unit: m\n# up: {}\n", job_.options.up);
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
            std::size_t lateral;
        };
        std::vector<Open> open{{trunk, tree_.axes[trunk].first, 0}};
        add_internode(trunk, tree_.axes[trunk].first);
        while (!open.empty()) {
            Open& top = open.back();
            if (top.lateral < tree_.axes_borne[top.internode].size()) {
                const AxisIndex lateral = tree_.axes_borne[top.internode][top.lateral++];
                open.push_back({lateral, tree_.axes[lateral].first, 0});
                add_internode(lateral, tree_.axes[lateral].first);
            } else if (top.internode.next() < tree_.axes[top.axis].end) {
                ++top.internode;
                top.lateral = 0;
                add_internode(top.axis, top.internode);
            } else {
                open.pop_back();
            }
        }
    }

    std::string code(AxisIndex axis, InternodeIndex internode) const {
        if (internode > tree_.axes[axis].first) return fmt::format("^<I{}", internode.number + 1);
        const bool trunk = tree_.axes[axis].bearer.is_none();
        return fmt::format("{}A{}/I{}", trunk ? prefix_ + "/" : "+", axis.number + 1, internode.number + 1);
    }

    void add_internode(AxisIndex axis, InternodeIndex number) {
        const FrameInternode& internode = tree_.internodes[number];
        const glm::vec3 tip = upright(internode.tip, job_.options.up);
        const std::uint32_t column = column_of_[axis];
        text_.append(column, '\t').append(code(axis, number)).append(width_ - column, '\t');
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
            const AxisTree tree = axis_tree(job.run.geometry(*frame), job.options);
            const auto path = job.path(*frame, extension());
            write_text(path, MtgText(job, tree).text());
            job.report({path, 0, 0, tree.internodes.size(), "internodes"});
        }
    }
};

const Registered<ExporterType> entry{
    {"mtg", "multiscale tree graph, a file per frame: for OpenAlea",
     "Scales plant P, axis A, internode I; < follows, + is borne by. Features: plant, order, birth, length, diameter\n"
     "(in the middle), XX YY ZZ (of the tip), identity. Axes that stand on nothing begin a P of their own.\n"
     "Lost: organs and surfaces, parameters",
     construct<Mtg>}};

}  // namespace
}  // namespace espalier::formats
