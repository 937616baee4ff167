#include "lsystem/derive/scopes.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::lsystem {
namespace {

constexpr std::uint32_t deepest = 100;

/// Throws RunError naming the way in if `system` is one of those it would stand in.
void require_not_inside_itself(const std::vector<Scope>& scopes, std::uint32_t around, const CompiledSystem& system,
                               std::uint32_t step) {
    std::string way = system.system->label;
    for (std::uint32_t scope = around;; scope = scopes[scope].parent) {
        way = fmt::format("{} > {}", scopes[scope].system->system->label, way);
        if (scopes[scope].system == &system) {
            throw RunError(fmt::format("{}: L-system {} stands inside itself ({}), at step {}", system.source->name,
                                       system.system->label, way, step));
        }
        if (scope == 0) return;
    }
}

}  // namespace

void Scopes::find(const CompiledModel& model, const ModuleString& string, std::uint32_t step) {
    scopes_.assign(1, {&model.main(), 0, 0, 0, 0, false, false});
    passages_.clear();
    saved_.clear();
    current_ = 0;
    run_ = run_parameters_ = 0;
    cutting_ = false;
    const auto arities = model.source->alphabet.arities();
    std::size_t at = 0;
    for (std::size_t i = 0; i < string.size(); ++i) {
        const LetterId letter = string.letters[i];
        const std::size_t next = at + arities[letter];
        if (letter == Alphabet::open_bracket) {
            saved_.push_back(current_);
        } else if (letter == Alphabet::close_bracket) {
            if (!saved_.empty() && (cutting_ || saved_.back() != current_)) end_run(i, at);
            close_branch();
        } else if (letter == Alphabet::cut && !cutting_ && scopes_[current_].system->may_cut) {
            end_run(i, at);
            cutting_ = true;
            cut_scope_ = current_;
            cut_level_ = saved_.size();
        } else if (letter == model.enclosure.close) {
            end_run(i, at);
            if (cutting_ && cut_scope_ == current_ && saved_.size() == cut_level_) cutting_ = false;
            close_scope();
        } else if (model.enclosure.opens(letter)) {
            end_run(i + 1, next);
            open(model, string.parameters[at], string.has_lineage() ? string.identity(i) : mix(i), step);
        }
        at = next;
    }
    end_run(string.size(), at);
    for (saved_.push_back(current_); !saved_.empty(); saved_.pop_back()) {
        for (std::uint32_t scope = saved_.back(); scope != 0; scope = scopes_[scope].parent) leave(scope);
    }
}

/// Hands on the modules since the last passage.
void Scopes::end_run(std::size_t module, std::size_t parameters_at) {
    using enum Passage::Kind;
    if (module > run_) passages_.push_back({cutting_ ? cut_off : rewrite, current_, run_, module, run_parameters_});
    run_ = module;
    run_parameters_ = parameters_at;
}

void Scopes::open(const CompiledModel& model, double id, Identity identity, std::uint32_t step) {
    const CompiledSystem* const system = model.labelled(id);
    if (!system) {
        throw RunError(fmt::format("{}: ?({:g}) asks for an L-system that does not exist, at step {}; there is {}",
                                   model.source->name, id, step, model.labels()));
    }
    require_not_inside_itself(scopes_, current_, *system, step);
    const Scope& around = scopes_[current_];
    if (around.depth >= deepest) {
        throw RunError(
            fmt::format("{}: L-systems are nested more than {} deep, at step {}", model.source->name, deepest, step));
    }
    scopes_.push_back(
        {system, current_, identity, static_cast<std::uint32_t>(saved_.size()), around.depth + 1, cutting_, false});
    current_ = static_cast<std::uint32_t>(scopes_.size() - 1);
    passages_.push_back({Passage::Kind::enter, current_, run_, run_, run_parameters_});
}

// Within a branch that the scope is older than, `$` ends it for the rest of that branch only.
void Scopes::close_scope() {
    if (current_ == 0) return;
    const std::uint32_t ended = current_;
    current_ = scopes_[ended].parent;
    if (scopes_[ended].level == saved_.size()) leave(ended);
}

void Scopes::close_branch() {
    if (saved_.empty()) return;
    for (std::uint32_t scope = current_; scope != 0 && scopes_[scope].level == saved_.size();) {
        const std::uint32_t around = scopes_[scope].parent;
        leave(scope);
        scope = around;
    }
    if (cutting_ && cut_level_ == saved_.size()) cutting_ = false;
    current_ = saved_.back();
    saved_.pop_back();
}

void Scopes::leave(std::uint32_t scope) {
    if (scopes_[scope].left) return;
    scopes_[scope].left = true;
    passages_.push_back({Passage::Kind::leave, scope, run_, run_, run_parameters_});
}

std::uint32_t Scopes::of_module(std::size_t module) const {
    const auto after = std::upper_bound(passages_.begin(), passages_.end(), module,
                                        [](std::size_t at, const Passage& passage) { return at < passage.begin; });
    for (auto passage = after; passage != passages_.begin();) {
        --passage;
        if (passage->kind == Passage::Kind::enter || passage->kind == Passage::Kind::leave) continue;
        return module < passage->end ? passage->scope : 0;
    }
    return 0;
}

}  // namespace espalier::lsystem
