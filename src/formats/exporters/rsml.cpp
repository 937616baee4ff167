// Root System Markup Language (Lobet et al. 2015): axes as polylines with diameters, laterals inside what bears them.
#include "espalier/base/file.h"
#include "espalier/formats/exporter.h"

#include "archive/meshes/axis_tree.h"
#include "archive/meshes/surface_mesh.h"
#include "base/text.h"
#include "base/xml_text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <iterator>

namespace espalier::formats {
namespace {

using AxisIndex = AxisTree::AxisIndex;

class RsmlText {
public:
    RsmlText(const ExportJob& job, const RecordedFrame& frame, const AxisTree& tree)
        : job_(job), frame_(frame), tree_(tree) {}

    std::string text() {
        add_head();
        const std::vector<AxisIndex> trunks = tree_.trunks();
        for (std::size_t i = 0; i < trunks.size(); ++i) {
            const std::uint32_t plant = tree_.axes[trunks[i]].plant;
            if (i == 0 || tree_.axes[trunks[i - 1]].plant != plant) {
                if (i > 0) put("    </plant>\n");
                put("    <plant ID=\"{}\" label=\"{}\">\n", plant, xml_text(job_.run.plants()[plant].name));
            }
            add_with_laterals(trunks[i]);
        }
        if (!trunks.empty()) put("    </plant>\n");
        put("  </scene>\n</rsml>\n");
        return std::move(text_);
    }

private:
    template <class... Values>
    void put(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    }

    void add_head() {
        put("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<rsml xmlns:po=\"http://www.plantontology.org/xml-dtd/po.dtd\">\n"
            "  <metadata>\n    <version>1</version>\n    <unit>m</unit>\n    <resolution>1</resolution>\n"
            "    <software>espalier</software>\n    <up>{}</up>\n    <file-key>{}</file-key>\n"
            "    <time-sequence>\n      <label>{}</label>\n      <index>{}</index>\n      <unified>true</unified>\n"
            "    </time-sequence>\n    <property-definitions>\n",
            job_.options.up, xml_text(job_.run.scene()), xml_text(job_.run.scene()), frame_.step);
        for (const auto& [label, type, unit] : {std::tuple{"length", "float", "m"},
                                                {"birth", "integer", "step"},
                                                {"order", "integer", "1"},
                                                {"parent-node", "integer", "1"},
                                                {"continues", "integer", "1"},
                                                {"identity", "string", "1"}}) {
            put("      <property-definition>\n        <label>{}</label>\n        <type>{}</type>\n"
                "        <unit>{}</unit>\n      </property-definition>\n",
                label, type, unit);
        }
        put("    </property-definitions>\n  </metadata>\n  <scene>\n");
    }

    // Laterals of laterals without recursion: there may be any number of orders. What goes on behind a gap stands
    // behind the piece before it, not within: there may be any number of gaps.
    void add_with_laterals(AxisIndex trunk) {
        struct Open {
            AxisIndex axis;
            InternodeIndex internode;
            std::size_t lateral;
            AxisIndex further = {};
        };
        std::vector<Open> open;
        const auto begin = [&](AxisIndex axis) {
            begin_axis(axis, open.size());
            open.push_back({axis, tree_.axes[axis].first, 0});
        };
        begin(trunk);
        while (!open.empty()) {
            Open& top = open.back();
            if (top.internode == tree_.axes[top.axis].end) {
                const AxisIndex further = top.further;
                open.pop_back();
                put("      </root>\n");
                if (!further.is_none()) begin(further);
            } else if (top.lateral == tree_.axes_borne[top.internode].size()) {
                ++top.internode;
                top.lateral = 0;
            } else {
                const AxisIndex borne = tree_.axes_borne[top.internode][top.lateral++];
                tree_.axes[borne].goes_on ? void(top.further = borne) : begin(borne);
            }
        }
    }

    void begin_axis(AxisIndex number, std::size_t depth) {
        const AxisTree::Axis& axis = tree_.axes[number];
        const FrameInternode& first = tree_.internodes[axis.first];
        double length = 0;
        for (InternodeIndex i = axis.first; i < axis.end; ++i) {
            length += glm::distance(tree_.internodes[i].base, tree_.internodes[i].tip);
        }
        // Plant Ontology: primary root, lateral root.
        put("      <root ID=\"{}\" label=\"axis {}\" po:accession=\"{}\">\n", number.number, number.number,
            depth == 0 ? "PO:0020127" : "PO:0020121");
        put("        <properties>\n          <length value=\"{}\"/>\n          <birth value=\"{}\"/>\n"
            "          <order value=\"{}\"/>\n          <identity value=\"{}\"/>\n",
            format_exact(length), first.birth, first.order, first.identity);
        if (axis.goes_on) {
            put("          <continues value=\"{}\"/>\n", axis_of(axis.bearer).number);
        } else if (depth > 0 && !hangs_at_gap(axis)) {
            put("          <parent-node value=\"{}\"/>\n", node_of_bearer(axis));
        }
        put("        </properties>\n");
        add_geometry(axis);
    }

    /// What an internode belongs to.
    AxisIndex axis_of(InternodeIndex internode) const {
        const auto behind =
            std::upper_bound(tree_.axes.begin(), tree_.axes.end(), internode,
                             [](InternodeIndex each, const AxisTree::Axis& other) { return each < other.first; });
        return AxisIndex(static_cast<std::size_t>(std::prev(behind) - tree_.axes.begin()));
    }

    /// Beside the end of its bearer, which goes on behind a gap: it may hang within that, where no node is.
    bool hangs_at_gap(const AxisTree::Axis& axis) const {
        const std::vector<AxisIndex>& borne = tree_.axes_borne[axis.bearer];
        return tree_.internodes[axis.first].base != tree_.internodes[axis.bearer].tip &&
               std::any_of(borne.begin(), borne.end(), [&](AxisIndex each) { return tree_.axes[each].goes_on; });
    }

    /// The node of the bearing axis, from 0, that an axis stands on: the tip of its bearer, or where both begin.
    std::int32_t node_of_bearer(const AxisTree::Axis& axis) const {
        const InternodeIndex bearer = axis.bearer;
        const AxisTree::Axis& bearing = tree_.axes[axis_of(bearer)];
        const glm::vec3 base = tree_.internodes[axis.first].base;
        const FrameInternode& internode = tree_.internodes[bearer];
        const bool at_tip = glm::distance(base, internode.tip) <= glm::distance(base, internode.base);
        return bearer.number - bearing.first.number + (at_tip ? 1 : 0);
    }

    void add_geometry(const AxisTree::Axis& axis) {
        const FrameInternode& first = tree_.internodes[axis.first];
        put("        <geometry>\n          <polyline>\n");
        add_point(first.base);
        for (InternodeIndex i = axis.first; i < axis.end; ++i) add_point(tree_.internodes[i].tip);
        put("          </polyline>\n        </geometry>\n        <functions>\n"
            "          <function name=\"diameter\" domain=\"polyline\">\n");
        put("            <sample>{}</sample>\n", 2 * first.base_radius);
        for (InternodeIndex i = axis.first; i < axis.end; ++i) {
            put("            <sample>{}</sample>\n", 2 * tree_.internodes[i].tip_radius);
        }
        put("          </function>\n          <function name=\"node_creation_time\" domain=\"polyline\">\n");
        add_time(first.birth);
        for (InternodeIndex i = axis.first; i < axis.end; ++i) add_time(tree_.internodes[i].birth);
        put("          </function>\n        </functions>\n");
    }

    void add_time(std::int32_t birth) {
        put("            <sample>{}</sample>\n", format_general(birth * job_.run.dt()));
    }

    void add_point(const glm::vec3& position) {
        const glm::vec3 v = upright(position, job_.options.up);
        put("            <point x=\"{}\" y=\"{}\" z=\"{}\"/>\n", v.x, v.y, v.z);
    }

    const ExportJob& job_;
    const RecordedFrame& frame_;
    const AxisTree& tree_;
    std::string text_;
};

class Rsml final : public Exporter {
public:
    std::string extension() const override { return "rsml"; }

    void write(const ExportJob& job) const override {
        for (const RecordedFrame* frame : job.frames) {
            AxisTree tree = axis_tree(job.run.geometry(*frame), job.options);
            settle_bearers(tree);
            const auto path = job.path(*frame, extension());
            write_text(path, RsmlText(job, *frame, tree).text());
            job.report({path, 0, 0, tree.axes.size(), "axes"});
        }
    }
};

const Registered<ExporterType> entry{
    {"rsml", "Root System Markup Language, a file per frame: for root software",
     "Plants, axes as polylines in metres with a diameter and the time of birth at every node, in the run's unit of\n"
     "time; laterals nested in the axis that bears them; length, birth, order, identity and the bearing axis's node as "
     "properties.\n"
     "For CPlantBox, --up z.\n"
     "An axis that begins beside the one that bears it hangs on the nearest of its nodes. Read again, it is the same "
     "plant.\n"
     "What goes on behind a gap is a root\n"
     "of its own, whose property continues is the ID of the piece before it. Lost: organs and surfaces, parameters",
     construct<Rsml>}};

}  // namespace
}  // namespace espalier::formats
