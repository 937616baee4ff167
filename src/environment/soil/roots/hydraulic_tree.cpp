#include "environment/soil/roots/hydraulic_tree.h"

#include "espalier/base/math.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {

CollarView HydraulicTree::look(const std::vector<RootPiece>& pieces) {
    ports_.assign(pieces.size(), {});
    CollarView collar;
    double weighted = 0;
    for (std::size_t i = pieces.size(); i-- > 0;) {
        const RootPiece& piece = pieces[i];
        Port& port = ports_[i];
        const double x =
            std::min(300.0, piece.length * std::sqrt(piece.surface_per_length * piece.radial / piece.axial));
        const double up = math::exp(x), down = 1 / up;
        const double sinh = x < 1e-3 ? x * (1 + x * x / 6) : 0.5 * (up - down);
        const double plain = piece.axial / piece.length;
        port.a = x > 0 ? plain * x / sinh : plain;
        port.c = 0.5 * (up + down);
        port.storage = plain * x * sinh;
        port.half = plain * x * sinh / (1 + port.c);
        if (port.load > 0) port.load_head /= port.load;
        // The flow out of the base is conductance (head - head at the base).
        const double below = port.a * port.c + port.load;
        port.conductance = port.a * (port.storage + port.c * port.load) / below;
        const double drawn = port.a * port.load * (port.load_head - piece.outside) / below;
        port.head = port.conductance > 0 ? piece.outside + drawn / port.conductance : piece.outside;
        if (piece.bearer == RootPiece::collar) {
            collar.conductance += port.conductance;
            weighted += port.conductance * port.head;
        } else {
            ports_[piece.bearer].load += port.conductance;
            ports_[piece.bearer].load_head += port.conductance * port.head;
        }
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
        const double tip =
            (port.a * base + port.load * (port.load_head - piece.outside)) / (port.a * port.c + port.load);
        result.tip[i] = tip + piece.outside;
        result.uptake[i] = -port.half * (base + tip);
        if (stands_on_collar) result.transpiration += port.a * (tip - port.c * base);
    }
}

}  // namespace espalier::environment
