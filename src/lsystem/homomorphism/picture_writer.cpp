#include "lsystem/homomorphism/picture_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::lsystem {
namespace {

constexpr std::size_t most_modules = 100'000'000;  // most modules of one picture, whatever memory there is
constexpr std::size_t modules_between_looks = 4096;

}  // namespace

SystemPictures::SystemPictures(const CompiledSystem& system)
    : rules(system.homomorphism),
      machine(system.machine()),
      matcher(system, machine),
      expansion(system.homomorphism, matcher, machine, nullptr) {
    for (const CompiledProduction& production : rules.productions) {
        final.push_back(rules.maximum_depth <= 1 || !rules.follow(production));
    }
}

PictureWriter::PictureWriter(const CompiledModel& model) : model_(model) {
    for (const auto& system : model_.systems) {
        systems_.push_back(std::make_unique<SystemPictures>(*system));
        changes_ |= system->picture_changes();
    }
}

void PictureWriter::work_for(Derivation::State& state) {
    if (serial_ == state.serial) return;
    serial_ = state.serial;
    state_ = &state;
    services_ = state.services;
    string_ = nullptr;
}

void PictureWriter::prepare(const CompiledSystem& system, Variables& variables, const StringView& view) {
    SystemPictures& used = pictures_of(system);
    used.machine.attach(&variables, &services_, Stream::homomorphism);
    used.matcher.view(view);
    if (!system.picture_samples()) return;
    used.matcher.set_random(RandomKey(state_->settings.seed, state_->settings.plant, Stream::homomorphism,
                                      system.homomorphism.salt.value_or(state_->services.salt)),
                            state_->step);
}

/// A homomorphism that multiplies at every depth is caught before it has eaten the machine.
void PictureWriter::require_bounds(const ModuleString& picture, const CompiledProduction& production) const {
    if (picture.size() % modules_between_looks != 0) return;
    if (picture.size() < most_modules && picture.bytes() <= state_->memory) return;
    throw RunError(
        fmt::format("{}: the picture of one module grows beyond {} modules; look at the maximum depth of "
                    "the homomorphism",
                    to_string(production.source->place), picture.size()));
}

std::size_t PictureWriter::write(const Subject& subject, ModuleString& picture) {
    services_.salt = state_->services.salt;
    services_.stopped = false;
    const CompiledSystem* system = &model_.main();
    if (model_.nested) {
        look_at(subject.string);
        scope_ = scopes_.of_module(subject.site.first);
        system = scopes_.all()[scope_].system;
        const CompiledRules& rules = system->homomorphism;
        if (!rules.has(subject.site.letter) || rules.maximum_depth == 0) return 0;
        prepare(*system, variables_of(scope_), subject.view);
    } else if (changes_) {
        copy_ = state_->variables;
        prepare(*system, copy_, subject.view);
    } else {
        prepare(*system, state_->variables, subject.view);
    }
    SystemPictures& used = pictures_of(*system);
    const CompiledProduction* production = used.matcher.choose(system->homomorphism, subject.site);
    if (production && !model_.nested && used.is_final(*production)) {
        used.matcher.begin_successor(*production, subject.site);
        lay_out(used, *production, picture);
    } else if (production) {
        strict_.assign(production->strict.size(), {subject.site.identity});
        used.matcher.begin_successor(*production, subject.site);
        stack_.clear();
        used.expansion.push_successor(*production, subject.site.values, strict_.data(), state_->step, 1, stack_);
        Subject inside = subject;
        inside.site.width = production->strict.size();
        if (model_.nested)
            expand_nested(inside, *production, picture);
        else
            expand(inside, *production, picture);
    }
    if (model_.nested && changes_) forget_variables();
    return production ? production->strict.size() : 0;
}

void PictureWriter::lay_out(SystemPictures& used, const CompiledProduction& production, ModuleString& picture) const {
    if (!production.after.empty()) used.machine.run(production.after);
    used.machine.run(production.successor);
    const std::size_t first = picture.parameters.size();
    picture.parameters.resize(first + production.parameters);
    double* const values = picture.parameters.data() + first;
    bool finite = true;
    for (std::size_t k = 0; k < production.parameters; ++k) {
        values[k] = used.machine.value(production.successor.results[k]);
        finite = finite && std::isfinite(values[k]);
    }
    if (!finite) require_finite(production, values);
    const LetterId* const letters = production.letters.data();
    picture.letters.insert(picture.letters.end(), letters, letters + production.length);
}

void PictureWriter::expand(const Subject& subject, const CompiledProduction& production, ModuleString& picture) {
    pictures_of(model_.main())
        .expansion.run(stack_, subject.site, state_->step, [&](const ModuleStack::Entry& entry, const double* values) {
            picture.append(entry.letter, {values, entry.arity});
            require_bounds(picture, production);
        });
}

// What the picture encloses in ?(id) ... $ is drawn by that L-system's homomorphism.
void PictureWriter::expand_nested(const Subject& subject, const CompiledProduction& production, ModuleString& picture) {
    inner_.clear();
    level_ = 0;
    while (!stack_.empty()) {
        Expansion& expansion = pictures_of(current()).expansion;
        const ModuleStack::Entry* finished = expansion.replace(stack_, subject.site, state_->step);
        if (!finished) continue;
        picture.append(finished->letter, {expansion.values(), finished->arity});
        require_bounds(picture, production);
        pass(finished->letter, expansion.values(), subject);
    }
}

void PictureWriter::pass(LetterId letter, const double* values, const Subject& subject) {
    if (letter == Alphabet::open_bracket) {
        ++level_;
    } else if (letter == Alphabet::close_bracket) {
        while (!inner_.empty() && inner_.back().level == level_) inner_.pop_back();
        --level_;
    } else if (model_.enclosure.opens(letter)) {
        open(values[0], subject);
    } else if (letter == model_.enclosure.close && !inner_.empty()) {
        inner_.pop_back();
    }
}

void PictureWriter::open(double id, const Subject& subject) {
    const CompiledSystem* const system = model_.labelled(id);
    bool inside = system == nullptr;
    for (const Inner& around : inner_) inside |= around.system == system;
    for (std::uint32_t scope = scope_; !inside; scope = scopes_.all()[scope].parent) {
        inside = scopes_.all()[scope].system == system;
        if (scope == 0) break;
    }
    if (inside) {
        throw RunError(fmt::format(
            "{}: a homomorphism opens ?({:g}), which {}, at step {}; there is {}", model_.source->name, id,
            system ? "would stand inside itself" : "is not an L-system of this model", state_->step, model_.labels()));
    }
    const CompiledSystem& around = current();
    Variables& theirs = inner_.empty() ? variables_of(scope_) : *inner_.back().variables;
    auto variables = std::make_unique<Variables>(system->variables());
    borrow(*system, *variables, around, theirs);
    run_start(*system, *variables);
    prepare(*system, *variables, subject.view);
    inner_.push_back({system, std::move(variables), level_});
}

void PictureWriter::look_at(const ModuleString& string) {
    if (string_ == string.letters.data() && size_ == string.size() && generation_ == state_->generation) return;
    scopes_.find(model_, string, state_->step);
    string_ = string.letters.data();
    size_ = string.size();
    generation_ = state_->generation;
    variables_.clear();
    variables_.resize(scopes_.all().size());
    made_.clear();
}

/// A copy of the variables of a scope, and of those around it. One that was never entered is started for the picture.
Variables& PictureWriter::variables_of(std::uint32_t scope) {
    if (variables_[scope]) return *variables_[scope];
    const Scope& own = scopes_.all()[scope];
    const Variables* const grown = scope == 0 ? &state_->variables : state_->sub_systems.find(own);
    auto made = std::make_unique<Variables>(grown ? *grown : own.system->variables());
    if (scope != 0) borrow(*own.system, *made, *scopes_.all()[own.parent].system, variables_of(own.parent));
    if (!grown) run_start(*own.system, *made);
    made_.push_back(scope);
    return *(variables_[scope] = std::move(made));
}

// Its real Start block is still to come: this one is neither heard nor seen.
void PictureWriter::run_start(const CompiledSystem& system, Variables& variables) {
    state_->dry_run([&](Services& silent) {
        Machine machine = system.machine();
        machine.attach(&variables, &silent, Stream::blocks);
        machine.sample_with(state_->block_random);
        machine.run(system.start);
    });
}

void PictureWriter::forget_variables() {
    for (const std::uint32_t scope : made_) variables_[scope] = nullptr;
    made_.clear();
}

}  // namespace espalier::lsystem
