#include "studio/session/growths.h"

#include "studio/document/document_files.h"
#include "studio/document/sharing.h"
#include "studio/growth/recording.h"

#include <climits>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace espalier::studio {
namespace {

/// A growth that takes longer shows its steps as they come, even if only something was edited.
constexpr double patience_with_edits = 0.7;
/// While something is dragged, a growth may take so long before the next change replaces it.
constexpr double least_growth = 0.4;

}  // namespace

Growths::Growths(const StudioOptions& options, Pages& pages, OpenDocument& document, DocumentDisk& disk,
                 HandedFiles& files, Workers& workers, Post post)
    : options_(options),
      pages_(pages),
      document_(document),
      disk_(disk),
      files_(files),
      listener_(*this, std::move(post)),
      printed_(pages),
      workers_(workers) {}

void Growths::begin(const DocumentChange& change) {
    follow_from_ = change.follow_from.value_or(change.is_other ? 0 : INT_MAX);
    waits_ = true;
    begin_next();
}

void Growths::tick() {
    begin_next();
    retired_.forget_ended();
}

void Growths::begin_next() {
    if (!waits_ || !document_.is_open()) return;
    // A drag shows what it passes, even if it changes faster than the plant grows.
    const PlantSource* const latest = next_ ? next_.get() : shown_ ? &shown_->source() : nullptr;
    if (document_.history().is_transient() && latest && is_busy_ && latest->seconds() < least_growth) return;
    waits_ = false;
    is_busy_ = true;
    retired_.add(std::move(next_));
    // Of a document that has been shown, changes may be lost half-way: it is found again with them.
    is_opening_ = is_opening_ || document_.path() != opened_;
    if (is_opening_) disk_.note_opening();
    GrowthOrder order = next_order();
    if (is_run(document_.path())) {
        next_ = std::make_unique<Recording>(std::move(order), listener_, workers_);
    } else {
        next_ = std::make_unique<Growth>(std::move(order), listener_, workers_);
    }
}

GrowthOrder Growths::next_order() {
    const DocumentState& now = document_.now();
    GrowthOrder order{++last_number_, document_.version(), now.opened, now.unsaved, options_.scratch, options_.read};
    if (shown_) {
        shown_->source().pause_drawing(true);
        order.before = shown_->source().shared_steps();
    }
    order.permission = permission_of(now.opened.path, options_.library_folder);
    order.memory = options_.memory;
    order.may_be_large = may_be_large_ == now.opened.path;
    order.unseen_to = follow_from_;
    for (const auto& viewer : pages_.all()) {
        if (viewer->step) order.looked_at.insert(*viewer->step);
    }
    return order;
}

void Growths::grow_to(int step) {
    if (!shown_) throw UserError("nothing grows");
    const int known = newest_step();
    const bool is_present = !next_ && !waits_ && shown_->source().version() == document_.version();
    document_.edited();
    const bool goes_on = is_present && step > known && shown_->source().extend(step, document_.version() + 1);
    document_.set_steps(step, known, goes_on);
    if (!goes_on) return;
    if (has_asked_) allow_more();
    progress_.newest.last_step = step;
    follow_from_ = known + 1;
    note_going();
}

void Growths::note_going() {
    progress_.state = "growing";
    progress_.reason.clear();
    is_busy_ = true;
    broadcast_progress();
}

void Growths::go_on() {
    if (progress_.state != "asks") throw UserError("no growth asks whether to go on");
    allow_more();
    note_going();
}

void Growths::allow_more() {
    has_asked_ = false;
    may_be_large_ = shown_->source().opened().path;
    shown_->source().go_on();
}

void Growths::stop() {
    if (shown_) shown_->source().stop();
    if (next_) next_->stop();
    if (progress_.state == "asks") note_stopped(shown_->number());
}

const ShownGrowth& Growths::shown(std::uint32_t number) const {
    if (!is_shown(number)) throw UserError("this growth is gone; another has begun");
    return *shown_;
}

void Growths::show(Viewer& viewer) const {
    if (!shown_ || newest_step() < 0) return;
    shown_->send_when_drawn(viewer, std::min(viewer.step.value_or(newest_step()), newest_step()), files_);
}

void Growths::send_to(Viewer& viewer) const {
    if (!shown_) return;
    Pages::send(viewer, shown_->progress_message(progress_));
    Pages::send(viewer, shown_->columns_message());
    Pages::send(viewer, shown_->fields_message());
    Pages::send(viewer, shown_->view_message());
    Pages::send(viewer, statistics_.message(shown_->number()));
    show(viewer);
}

void Growths::note_started(std::uint32_t growth, GrowthStart start) {
    if (!next_ || next_->number() != growth) return;
    if (shown_) retired_.add(shown_->release());
    shown_.emplace(std::move(next_), std::move(start));
    disk_.watch(shown_->start().files);
    printed_.clear();
    statistics_.clear();
    progress_ = {"growing", "", {}};
    has_asked_ = false;
    progress_.newest.step = -1;
    progress_.newest.last_step = shown_->start().last_step;
    document_.note_started(shown_->source().opened(), shown_->start());
    broadcast_progress();
    pages_.broadcast(shown_->columns_message());
    pages_.broadcast(shown_->fields_message());
    pages_.broadcast(shown_->view_message());
    for (const auto& viewer : pages_.all()) {
        viewer->awaits.clear();
        if (viewer->step) shown_->send_when_drawn(*viewer, *viewer->step, files_);
    }
}

void Growths::note_grown(std::uint32_t growth, const GrownStep& step) {
    if (!is_shown(growth)) return;
    progress_.newest = step;
    progress_.newest.statistics.clear();
    progress_.state = step.is_end ? "done" : "growing";
    statistics_.add(step.statistics, step.units);
    if (step.is_end) is_busy_ = false;
    if (pace_.lets_through(step.is_end)) {
        broadcast_progress();
        broadcast_statistics();
    }
    show_step(step);
    note_opened(growth);
    begin_next();
    if (step.is_end) retired_.forget_ended();  // which takes its time: nothing waits for it now
}

// To the pages that look at it, or follow the growth.
void Growths::show_step(const GrownStep& step) {
    for (const auto& viewer : pages_.all()) {
        const bool follows = step.step >= follow_from_ || step.seconds > patience_with_edits;
        const bool wanted = viewer->step ? *viewer->step == step.step || (step.is_end && *viewer->step > step.step)
                                         : step.is_end || (follows && !viewer->page.is_behind());
        if (wanted) shown_->send(*viewer, step.step, files_);
    }
}

// A step that had to wait for the newest.
void Growths::note_drawn(std::uint32_t growth, int step, const std::string& statistics) {
    if (!is_shown(growth)) return;
    statistics_.add(statistics);
    if (pace_.lets_through(step == newest_step())) broadcast_statistics();
    for (const auto& viewer : pages_.all()) {
        if (viewer->awaits.contains(step)) shown_->send(*viewer, step, files_);
    }
}

void Growths::note_printed(std::uint32_t growth, const std::string& text) {
    if (is_shown(growth)) printed_.add(text);
}

// Pages that wait for a later step get the last there is.
void Growths::note_stopped(std::uint32_t growth) {
    if (!is_shown(growth)) return;
    rest("stopped", "");
}

void Growths::note_asking(std::uint32_t growth, std::size_t modules) {
    if (!is_shown(growth)) return;
    has_asked_ = true;
    rest("asks", fmt::format("step {} may have {} modules", newest_step() + 1, modules));
}

// It grows no further for the time being.
void Growths::rest(const char* state, const std::string& reason) {
    progress_.state = state;
    progress_.reason = reason;
    is_busy_ = false;
    broadcast_progress();
    broadcast_statistics();
    for (const auto& viewer : pages_.all()) show(*viewer);
    note_opened(shown_->number());
    begin_next();
}

// The newest growth shows something, or says why not.
void Growths::note_opened(std::uint32_t growth) {
    if (growth != last_number_ || !std::exchange(is_opening_, false)) return;
    opened_ = document_.path();
    disk_.note_opened();
}

void Growths::note_failed(std::uint32_t growth, const std::vector<Diagnostic>& why) {
    is_busy_ = false;
    note_opened(growth);
    if (next_ && next_->number() == growth) {
        retired_.add(std::move(next_));
        if (shown_) shown_->source().pause_drawing(false);
        document_.broadcast_if_untold();
        document_.set_problems(why);
    } else if (is_shown(growth)) {
        progress_.state = "failed";
        for (const Diagnostic& each : why) progress_.reason += (progress_.reason.empty() ? "" : "\n") + each.message;
        document_.set_problems(why);
        broadcast_progress();
    }
    begin_next();
}

void Growths::broadcast_statistics() {
    if (statistics_.has_untold()) pages_.broadcast(statistics_.take_untold(shown_->number()));
}

}  // namespace espalier::studio
