// A measured plant of 100,000 nodes, as files of several programs: a trunk of 1,000 pieces, 990 of which bear a branch
// of 100. Its files are written without being in memory, which tests and benches measure.
#pragma once

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include <cmath>
#include <fstream>

namespace espalier::large_plant {

constexpr int trunk = 1000, branches = 990, pieces = 100;
constexpr int nodes = trunk + branches * pieces;

/// Writes the plant into an open file.
using Write = void (*)(std::ofstream out);

/// Centimetres; the trunk is axis 0, and branch i stands on node i of it.
inline glm::dvec3 node(int axis, int i) {
    if (axis == 0) return {std::sin(0.02 * i), std::cos(0.02 * i), 2.0 * i};
    const glm::dvec3 base = node(0, axis);
    return base + glm::dvec3(0.5 * i * std::cos(axis), 0.5 * i * std::sin(axis), 0.3 * std::sin(0.1 * i));
}

inline int pieces_of(int axis) {
    return axis == 0 ? trunk : pieces;
}

inline void write_rsml(std::ofstream out) {
    out << "<rsml><metadata><unit>cm</unit></metadata><scene><plant label=\"p\">\n";
    for (int axis = 0; axis <= branches; ++axis) {
        out << fmt::format("<root label=\"root {}\"><geometry><polyline>\n", axis);
        for (int i = 0; i <= pieces_of(axis); ++i) {
            const glm::dvec3 at = node(axis, i);
            out << fmt::format("<point x=\"{:.4f}\" y=\"{:.4f}\" z=\"{:.4f}\"/>\n", at.x, at.y, at.z);
        }
        out << "</polyline></geometry><functions><function name=\"diameter\" domain=\"polyline\">\n";
        for (int i = 0; i <= pieces_of(axis); ++i) out << "<sample>0.05</sample>\n";
        out << (axis == 0 ? "</function></functions>\n" : "</function></functions></root>\n");
    }
    out << "</root></plant></scene></rsml>\n";
}

inline void write_mtg(std::ofstream out) {
    out << "# unit: "
           "cm\nCODE:\tFORM-A\nCLASSES:\nSYMBOL\tSCALE\nP\t1\nA\t2\nS\t3\nFEATURES:\nXX\tREAL\nYY\tREAL\nZZ\tREAL\n"
           "TopDia\tREAL\nMTG:\nENTITY-CODE\t\tXX\tYY\tZZ\tTopDia\n";
    const auto row = [&](int axis, int i, const char* code) {
        const glm::dvec3 at = node(axis, i);
        out << fmt::format("{}{}{}{}\t{:.4f}\t{:.4f}\t{:.4f}\t1\n", axis == 0 ? "" : "\t", code, i,
                           axis == 0 ? "\t" : "", at.x, at.y, at.z);
    };
    for (int i = 1; i <= trunk; ++i) {
        row(0, i, i == 1 ? "/P1/A1/S" : "^<S");
        if (i > branches) continue;
        for (int k = 1; k <= pieces; ++k) row(i, k, k == 1 ? "+S" : "^<S");
    }
}

inline void write_cylinders(std::ofstream out) {
    out << "ID,parentID,startX,startY,startZ,endX,endY,endZ,radius,length,branchID\n";
    const auto cylinder = [&](int id, int parent, int axis, int i) {
        const glm::dvec3 from = 0.01 * node(axis, i - 1), to = 0.01 * node(axis, i);
        out << fmt::format("{},{},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},0.005,{:.5f},{}\n", id, parent, from.x,
                           from.y, from.z, to.x, to.y, to.z,
                           std::hypot(std::hypot(to.x - from.x, to.y - from.y), to.z - from.z), axis);
    };
    for (int i = 1; i <= trunk; ++i) cylinder(i - 1, i - 2, 0, i);
    for (int axis = 1; axis <= branches; ++axis) {
        const int first = trunk + (axis - 1) * pieces;
        for (int i = 1; i <= pieces; ++i) cylinder(first + i - 1, i == 1 ? axis - 1 : first + i - 2, axis, i);
    }
}

}  // namespace espalier::large_plant
