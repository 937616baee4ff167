#include "environment/soil/roots/hydraulic_tree.h"

#include "espalier/base/math.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {

HydraulicTree::Port HydraulicTree::port_of(const RootPiece& piece) {
    const double x = std::min(300.0, piece.length * std::sqrt(piece.surface_per_length * piece.radial / piece.axial));
    const double up = math::exp(x), down = 1 / up;
    const double sinh = x < 1e-3 ? x * (1 + x * x / 6) : 0.5 * (up - down);
    const double plain = piece.axial / piece.length;
    Port port{};
    port.a = x > 0 ? plain * x / sinh : plain;
    port.c = 0.5 * (up + down);
    port.storage = plain * x * sinh;
    port.half = port.storage / (1 + port.c);
    return port;
}

CollarView HydraulicTree::look(const std::vector<RootPiece>& pieces) {
    ports_.resize(pieces.size());
    for_in_parallel(tbb::blocked_range<std::size_t>(0, pieces.size(), 4096), [&](const auto& part) {
        for (std::size_t i = part.begin(); i != part.end(); ++i) ports_[i] = port_of(pieces[i]);
    });
    CollarView collar;
    double weighted = 0;
    for (std::size_t i = pieces.size(); i-- > 0;) {
        const RootPiece& piece = pieces[i];
        Port& port = ports_[i];
        port.below = 1 / (port.a * port.c + port.load);
        // The flow out of the base is conductance (head - head at the base).
        const double conductance = port.a * (port.storage + port.c * port.load) * port.below;
        const double drawn = port.a * (port.weighted_load - port.load * piece.outside) * port.below;
        const bool stands_on_collar = piece.bearer == RootPiece::collar;
        (stands_on_collar ? collar.conductance : ports_[piece.bearer].load) += conductance;
        (stands_on_collar ? weighted : ports_[piece.bearer].weighted_load) += conductance * piece.outside + drawn;
    }
    if (collar.conductance > 0) collar.head = weighted / collar.conductance;
    return collar;
}

void HydraulicTree::flow(const std::vector<RootPiece>& pieces, double collar_head, RootFlow& result) const {
    result.collar_head = collar_head;
    result.transpiration = 0;
    result.tip.resize(pieces.size());
    result.uptake.resize(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const RootPiece& piece = pieces[i];
        const Port& port = ports_[i];
        const bool stands_on_collar = piece.bearer == RootPiece::collar;
        const double base = (stands_on_collar ? collar_head : result.tip[piece.bearer]) - piece.outside;
        const double tip = (port.a * base + (port.weighted_load - port.load * piece.outside)) * port.below;
        result.tip[i] = tip + piece.outside;
        result.uptake[i] = -port.half * (base + tip);
        if (stands_on_collar) result.transpiration += port.a * (tip - port.c * base);
    }
}

void HydraulicTree::answer_collar(const std::vector<RootPiece>& pieces, std::vector<double>& by_collar) const {
    std::vector<double> tips(pieces.size());
    by_collar.resize(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Port& port = ports_[i];
        const double base = pieces[i].bearer == RootPiece::collar ? 1 : tips[pieces[i].bearer];
        tips[i] = port.a * base * port.below;
        by_collar[i] = port.half * (base + tips[i]);
    }
}

}  // namespace espalier::environment
