#include "environment/soil/shoot/shoot_network.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

constexpr int most_steps = 400;
constexpr double tolerance = 1e-12;     ///< of the largest flow
constexpr double rounding = 1e-15;      ///< of what would flow if the whole head drove it
constexpr double trickle = 1e-5;        ///< flows below this share of that count as this
constexpr double longest_change = 2e4;  ///< cm in a step: where nothing conducts, the tangent tells nothing

/// Newton's change of a head, within its reach. Where it turns back, it went too far: the reach is halved, and grows
/// slower than that, so that no head swings forever. Over some cm all is as good as linear.
double clamped(double change, double change_before, double& reach) {
    constexpr double linear = 10;
    const bool turns = change * change_before < 0;
    reach = turns ? std::max(linear, 0.5 * std::abs(change_before)) : std::min(longest_change, 1.3 * reach);
    return std::clamp(change, -reach, reach);
}

}  // namespace

ShootNetwork::ShootNetwork(std::vector<ShootNode> nodes, double collar_height)
    : nodes_(std::move(nodes)), collar_height_(collar_height) {
    const std::size_t count = nodes_.size();
    for (std::vector<double>* column :
         {&flow_.head, &flow_.flow, &flow_.stored, &flow_.loss, &change_, &rest_, &reach_, &before_}) {
        column->assign(count, 0);
    }
    rows_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (nodes_[i].is_leaf) leaves_.push_back(i);
    }
    leaf_heads_.resize(leaves_.size());
    losses_.resize(leaves_.size());
}

void ShootNetwork::rest_at(double total_head) {
    flow_.collar_head = total_head - collar_height_;
    for (std::size_t i = 0; i < nodes_.size(); ++i) flow_.head[i] = total_head - nodes_[i].height;
}

double ShootNetwork::head_below(const ShootNode& node) const {
    return node.bearer == ShootNode::collar ? flow_.collar_head : flow_.head[node.bearer];
}

void ShootNetwork::find_flows() {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const ShootNode& node = nodes_[i];
        const double below = head_below(node), own = flow_.head[i];
        const double base = node.bearer == ShootNode::collar ? collar_height_ : nodes_[node.bearer].height;
        const double difference = below + base - own - node.height;
        const MeanLeft left = mean_left(node.conduits, below, own);
        Row& row = rows_[i];
        row.flow = node.conductance * left.mean * difference;
        row.by_bearer = node.conductance * (left.mean + left.by_first * difference);
        row.by_own = node.conductance * (-left.mean + left.by_second * difference);
    }
}

/// What each node gets and does not pass on, and its change with the node's own head. Returns the worst.
double ShootNetwork::measure(const CollarView& supply, const ShootLosses& losses, const ShootPast& past, double days,
                             double weight) {
    find_flows();
    for (std::size_t l = 0; l < leaves_.size(); ++l) leaf_heads_[l] = flow_.head[leaves_[l]];
    losses(leaf_heads_, losses_);
    flow_.intake = supply.conductance * (supply.head - flow_.collar_head - collar_height_);
    collar_rest_ = flow_.intake;
    scale_ = std::abs(flow_.intake);
    driven_ = supply.conductance * std::abs(flow_.collar_head);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        Row& row = rows_[i];
        const double capacity = days > 0 ? nodes_[i].capacity / (days * weight) : 0;
        const double risen = capacity > 0 ? flow_.head[i] - past.head[i] : 0;
        flow_.stored[i] = capacity > 0 ? capacity * risen - (1 - weight) / weight * past.stored[i] : 0;
        flow_.flow[i] = row.flow;
        flow_.loss[i] = 0;
        row.rest = row.flow - flow_.stored[i];
        row.diagonal = row.by_own - capacity;
        scale_ = std::max({scale_, std::abs(row.flow), std::abs(flow_.stored[i])});
        driven_ = std::max(driven_, -row.by_own * std::abs(flow_.head[i]));
    }
    for (std::size_t l = 0; l < leaves_.size(); ++l) {
        flow_.loss[leaves_[l]] = losses_[l].rate;
        rows_[leaves_[l]].rest -= losses_[l].rate;
        rows_[leaves_[l]].diagonal -= losses_[l].by_head;
        scale_ = std::max(scale_, std::abs(losses_[l].rate));
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const std::uint32_t bearer = nodes_[i].bearer;
        if (bearer == ShootNode::collar) {
            collar_rest_ -= rows_[i].flow;
        } else {
            rows_[bearer].rest -= rows_[i].flow;
            rows_[bearer].diagonal -= rows_[i].by_bearer;
        }
    }
    scale_ = std::max(scale_, trickle * driven_);
    double worst = std::abs(collar_rest_);
    for (const Row& row : rows_) worst = std::max(worst, std::abs(row.rest));
    return worst;
}

/// Newton's step into `change_` and `collar_change_`.
void ShootNetwork::eliminate(const CollarView& supply) {
    double collar_diagonal = -supply.conductance;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (nodes_[i].bearer == ShootNode::collar) collar_diagonal -= rows_[i].by_bearer;
    }
    double collar_rest = collar_rest_;
    std::vector<double>& rest = rest_;
    for (std::size_t i = 0; i < nodes_.size(); ++i) rest[i] = rows_[i].rest;
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        const Row& row = rows_[i];
        const double part = row.by_own / row.diagonal;
        const bool is_first = nodes_[i].bearer == ShootNode::collar;
        (is_first ? collar_diagonal : rows_[nodes_[i].bearer].diagonal) += part * row.by_bearer;
        (is_first ? collar_rest : rest[nodes_[i].bearer]) += part * rest[i];
    }
    by_collar_head_ = std::max(0.0, -collar_diagonal - supply.conductance);
    // A clamped change is passed on: what a node bears moves with it.
    collar_change_ = clamped(-collar_rest / collar_diagonal, collar_change_, collar_reach_);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const std::uint32_t bearer = nodes_[i].bearer;
        const double below = bearer == ShootNode::collar ? collar_change_ : change_[bearer];
        change_[i] = clamped(-(rest[i] + rows_[i].by_bearer * below) / rows_[i].diagonal, change_[i], reach_[i]);
    }
}

double ShootNetwork::allowed() const {
    return std::max(tolerance * scale_, rounding * driven_);
}

void ShootNetwork::move() {
    before_ = flow_.head;
    collar_before_ = flow_.collar_head;
    // Leaves give and do not take: no total head is above all those that water comes from.
    flow_.collar_head = std::min(flow_.collar_head + collar_change_, highest_ - collar_height_);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        flow_.head[i] = std::min(flow_.head[i] + change_[i], highest_ - nodes_[i].height);
    }
}

double ShootNetwork::highest(const CollarView& supply, const ShootPast& past, double days) const {
    double highest = supply.head;
    for (std::size_t i = 0; i < nodes_.size() && days > 0; ++i) {
        if (nodes_[i].capacity > 0) highest = std::max(highest, past.head[i] + nodes_[i].height);
    }
    return highest;
}

void ShootNetwork::solve(const CollarView& supply, const ShootLosses& losses, const ShootPast& past, double days,
                         double weight) {
    double worst = measure(supply, losses, past, days, weight);
    highest_ = highest(supply, past, days);
    std::fill(reach_.begin(), reach_.end(), longest_change);
    std::fill(change_.begin(), change_.end(), 0);
    collar_reach_ = longest_change;
    collar_change_ = 0;
    for (int step = 0; step < most_steps && worst > allowed(); ++step) {
        const double before = worst, good = 1e-10 * scale_;
        eliminate(supply);
        move();
        worst = measure(supply, losses, past, days, weight);
        if (worst < before || before > good) continue;
        flow_.head = before_;  // it was as good as it gets
        flow_.collar_head = collar_before_;
        worst = measure(supply, losses, past, days, weight);
        break;
    }
    flow_.residual = scale_ > 0 ? worst / scale_ : 0;
}

}  // namespace espalier::environment
