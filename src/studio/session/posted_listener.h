// What growths tell on their own threads, told on the session's.
#pragma once

#include "studio/growth/plant_source.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace espalier::studio {

/// Does work later on the session's thread, unless the session has ended.
using Post = std::function<void(std::function<void()>)>;

/// Told on the session's thread.
class GrowthNotes {
public:
    virtual ~GrowthNotes() = default;
    // As those of GrowthListener.
    virtual void note_started(std::uint32_t growth, GrowthStart start) = 0;
    virtual void note_grown(std::uint32_t growth, const GrownStep& step) = 0;
    virtual void note_drawn(std::uint32_t growth, int step, const std::string& statistics) = 0;
    virtual void note_printed(std::uint32_t growth, const std::string& text) = 0;
    virtual void note_stopped(std::uint32_t growth) = 0;
    virtual void note_asking(std::uint32_t growth, std::size_t modules) = 0;
    virtual void note_failed(std::uint32_t growth, const std::vector<Diagnostic>& why) = 0;
};

class PostedListener final : public GrowthListener {
public:
    /// The notes outlive what `post` does.
    PostedListener(GrowthNotes& notes, Post post) : notes_(notes), post_(std::move(post)) {}

    void started(std::uint32_t growth, GrowthStart start) override {
        post_([this, growth, start = std::move(start)]() mutable { notes_.note_started(growth, std::move(start)); });
    }
    void grown(std::uint32_t growth, GrownStep step) override {
        post_([this, growth, step = std::move(step)] { notes_.note_grown(growth, step); });
    }
    void drawn(std::uint32_t growth, int step, std::string statistics) override {
        post_([this, growth, step, rows = std::move(statistics)] { notes_.note_drawn(growth, step, rows); });
    }
    void printed(std::uint32_t growth, std::string text) override {
        post_([this, growth, text = std::move(text)] { notes_.note_printed(growth, text); });
    }
    void stopped(std::uint32_t growth) override {
        post_([this, growth] { notes_.note_stopped(growth); });
    }
    void asks(std::uint32_t growth, std::size_t modules) override {
        post_([this, growth, modules] { notes_.note_asking(growth, modules); });
    }
    void failed(std::uint32_t growth, std::vector<Diagnostic> why) override {
        post_([this, growth, why = std::move(why)] { notes_.note_failed(growth, why); });
    }

private:
    GrowthNotes& notes_;
    const Post post_;
};

}  // namespace espalier::studio
