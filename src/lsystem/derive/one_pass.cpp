// One pass over the string, appending: for models whose productions have an order, or decompose what they write.
#include "lsystem/derive/one_pass.h"

#include <algorithm>
#include <cstring>

namespace espalier {

GrowingString::GrowingString(ModuleString& string, const StepInput& input, std::atomic<std::size_t>& bytes, Room room)
    : string_(string), input_(input), bytes_(bytes) {
    string_.clear();
    if (room == Room::lent) return;
    modules_ = string_.letters.capacity();
    parameters_ = string_.parameters.capacity();
    held_ = string_.bytes();
    bytes_ += held_;
}

void GrowingString::grow(std::size_t more_modules, std::size_t more_parameters) {
    const std::size_t modules = string_.letters.size() + more_modules;
    const std::size_t parameters = string_.parameters.size() + more_parameters;
    if (modules > modules_) modules_ = std::max<std::size_t>(1024, (modules - 1) * 2);
    if (parameters > parameters_) parameters_ = std::max<std::size_t>(1024, parameters * 2);
    const std::size_t needed = bytes_needed({modules_, parameters_}, input_.ancestry);
    const std::size_t total = bytes_ += needed > held_ ? needed - held_ : 0;
    held_ = std::max(held_, needed);
    if (total > input_.memory || modules_ >= BranchLinks::none) refuse_memory(input_, modules_, total, uses);
    string_.letters.reserve(modules_);
    string_.parameters.reserve(parameters_);
    if (input_.ancestry != Ancestry::none) string_.identities.reserve(modules_);
    if (input_.ancestry != Ancestry::whole) return;
    string_.parents.reserve(modules_);
    string_.births.reserve(modules_);
}

void GrowingString::append_run(std::size_t begin, std::size_t end, const double* values, std::size_t parameters) {
    const bool has_room =
        end - begin <= modules_ - string_.letters.size() && parameters <= parameters_ - string_.parameters.size();
    if (!has_room) grow(end - begin, parameters);
    const auto append = [&](auto& column, const auto& old) {
        column.insert(column.end(), old.data() + begin, old.data() + end);
    };
    append(string_.letters, input_.from.letters);
    string_.parameters.insert(string_.parameters.end(), values, values + parameters);
    if (input_.ancestry == Ancestry::none) return;
    append(string_.identities, input_.from.identities);
    if (input_.ancestry == Ancestry::identities) return;
    append(string_.parents, input_.from.parents);
    append(string_.births, input_.from.births);
}

OnePass::OnePass(const StepInput& input, Machine& machine, Services& services, GrowingString& out)
    : input_(input),
      model_(input.model),
      machine_(machine),
      services_(services),
      out_(out),
      matcher_(input.model, input.view, machine),
      rewriting_(model_.rules, matcher_, machine),
      decomposition_(model_.decomposition, matcher_, machine) {
    matcher_.set_draws(input.key, input.step);
    if (model_.index == 0) out_.uses.resize(model_.rules.productions.size());
}

namespace {

/// Whether what a successor writes stands within a sub-L-system that the same successor opened.
class Inside {
public:
    bool any() const { return open_ > 0; }
    void pass(LetterId letter, const Enclosure& enclosure) {
        if (letter == Alphabet::open_bracket) {
            ++level_;
        } else if (letter == Alphabet::close_bracket) {
            if (level_-- == opened_at_) open_ = 0;
        } else if (enclosure.opens(letter)) {
            if (open_++ == 0) opened_at_ = level_;
        } else if (letter == enclosure.close && open_ > 0) {
            --open_;
        }
    }

private:
    int level_ = 0, opened_at_ = 0, open_ = 0;
};

}  // namespace

std::size_t OnePass::run(std::size_t begin, std::size_t end, std::size_t parameters_at) {
    const auto arities = model_.source->alphabet.arities();
    const LetterId* letters = input_.from.letters.data();
    const double* values = input_.from.parameters.data() + parameters_at;
    std::size_t i = begin;
    while (i < end) {
        if (lives_on(letters[i])) {
            const std::size_t first = i;
            const double* const first_values = values;
            for (; i < end && lives_on(letters[i]); ++i) values += arities[letters[i]];
            out_.append_run(first, i, first_values, static_cast<std::size_t>(values - first_values));
            continue;
        }
        const auto at = static_cast<std::size_t>(values - input_.from.parameters.data());
        const Site site{i, at, letters[i], values, lineage(i).identity, 0};
        std::size_t consumed = 0;
        try {
            decomposing_ = false;
            consumed = rewrite(site);
        } catch (const EvaluationError& error) {
            const LetterId letter = decomposing_ ? decomposition_.letter() : letters[i];
            throw RunError(describe(error, model_.source->alphabet, letter,
                                    decomposing_ ? decomposition_.values() : values, input_.step));
        }
        for (const std::size_t next = i + consumed; i < next; ++i) values += arities[letters[i]];
    }
    return i;
}

/// Replaces the modules at a site; returns how many they were.
std::size_t OnePass::rewrite(const Site& site) {
    const CompiledProduction* production = matcher_.choose(model_.rules, site);
    const std::size_t width = production ? production->strict.size() : 1;
    if (production) {
        if (model_.index == 0) ++out_.uses[static_cast<std::size_t>(production - model_.rules.productions.data())];
        matcher_.begin_successor(*production, site);
        strict_.clear();
        for (std::size_t k = 0; k < width; ++k) strict_.push_back(lineage(site.first + k));
        if (!production->decomposes && !enclosure_) {
            rewriting_.emit_successor(*production, site.values, strict_.data(), input_.step,
                                      [&](LetterId letter, const double* values, std::size_t arity,
                                          const Lineage& lineage) { out_.append(letter, values, arity, lineage); });
            follow_reseeding();
            return width;
        }
        rewriting_.push_successor(*production, site.values, strict_.data(), input_.step, 0, stack_);
        follow_reseeding();
    } else {
        const int arity = model_.source->alphabet.arity(site.letter);
        if (!model_.decomposition.has(site.letter)) {
            out_.append(site.letter, site.values, static_cast<std::size_t>(arity), lineage(site.first));
            return 1;
        }
        stack_.push({site.letter, static_cast<std::uint16_t>(arity), 0, lineage(site.first)}, site.values);
    }
    Site origin = site;
    origin.width = width;
    decompose(origin);
    return width;
}

void OnePass::run_within(std::size_t begin, std::size_t end, std::size_t parameters_at, const Enclosure& enclosure) {
    enclosure_ = &enclosure;
    matcher_.limit(end);
    set_draws();
    run(begin, end, parameters_at);
}

void OnePass::decompose(const Site& site) {
    decomposing_ = true;
    if (!enclosure_) {
        decomposition_.run(stack_, site, input_.step, [&](const ModuleStack::Entry& entry, const double* values) {
            out_.append(entry.letter, values, entry.arity, entry.lineage);
        });
    } else {
        decompose_within(site);
    }
    follow_reseeding();
}

void OnePass::decompose_within(const Site& site) {
    Inside inside;
    while (!stack_.empty()) {
        if (inside.any()) {
            const ModuleStack::Entry entry = stack_.pop(values_);
            out_.append(entry.letter, values_.data(), entry.arity, entry.lineage);
            inside.pass(entry.letter, *enclosure_);
            continue;
        }
        const ModuleStack::Entry* finished = decomposition_.replace(stack_, site, input_.step);
        if (!finished) continue;
        out_.append(finished->letter, decomposition_.values(), finished->arity, finished->lineage);
        inside.pass(finished->letter, *enclosure_);
    }
}

// srand() in a production begins the stream anew for all modules that follow, too.
void OnePass::follow_reseeding() {
    if (machine_.reseeded()) set_draws();
}

void OnePass::set_draws() {
    matcher_.set_draws(RandomKey(services_.seed, services_.plant, Stream::derivation, services_.salt), input_.step);
}

namespace {

void run_in_order(const StepInput& input, Scratch& scratch, Machine& machine, Services& services, GrowingString& out,
                  std::atomic<bool>& limit) {
    OnePass pass(input, machine, services, out);
    const auto arities = input.model.source->alphabet.arities();
    std::size_t at = 0, parameters_at = 0, rewritten = 0;
    for (const auto& [kept_begin, end] : scratch.kept) {
        const std::size_t begin = std::max(kept_begin, rewritten);
        for (; at < begin; ++at) parameters_at += arities[input.from.letters[at]];
        rewritten = pass.run(begin, end, parameters_at);
    }
    if (pass.reached_limit()) limit = true;
}

template <class T>
void copy_column(const Column<T>& from, Column<T>& to, std::size_t at) {
    if (!from.empty()) std::memcpy(to.data() + at, from.data(), from.size() * sizeof(T));
}

void copy_piece(const ModuleString& piece, ModuleString& to, std::size_t at, std::size_t parameters_at) {
    copy_column(piece.letters, to.letters, at);
    copy_column(piece.parameters, to.parameters, parameters_at);
    copy_column(piece.identities, to.identities, at);
    copy_column(piece.parents, to.parents, at);
    copy_column(piece.births, to.births, at);
}

void make_room(const StepInput& input, ModuleString& to, std::size_t modules, std::size_t parameters,
               std::size_t held) {
    const std::size_t bytes = held + bytes_needed({modules, parameters}, input.ancestry);
    if (bytes > input.memory || modules >= BranchLinks::none) refuse_memory(input, modules, bytes, {});
    resize(to, {modules, parameters}, input.ancestry);
}

void join(const StepInput& input, Scratch& scratch, Machines& machines, ModuleString& to, std::size_t held) {
    std::size_t modules = 0, parameters = 0;
    for (std::size_t k = 0; k < scratch.chunks.size(); ++k) {
        scratch.chunks[k].out = modules;
        scratch.chunks[k].out_parameters = parameters;
        modules += scratch.pieces[k].size();
        parameters += scratch.pieces[k].parameters.size();
    }
    make_room(input, to, modules, parameters, held);
    for_each_chunk(scratch.chunks, machines, [&](Chunk& chunk, Machine&) {
        const ModuleString& piece = scratch.pieces[static_cast<std::size_t>(&chunk - scratch.chunks.data())];
        copy_piece(piece, to, chunk.out, chunk.out_parameters);
    });
}

}  // namespace

void rewrite_in_one_pass(const StepInput& input, Scratch& scratch, Machines& machines, Services& services,
                         ModuleString& to, std::atomic<bool>& limit) {
    make_chunks(input, scratch);
    const std::size_t pieces = std::max<std::size_t>(scratch.chunks.size(), 1);
    if (scratch.pieces.size() < pieces) scratch.pieces.resize(pieces);
    std::atomic<std::size_t> bytes = bytes_before(input);
    if (scratch.chunks.size() == 1 || input.from.size() <= grain) {
        // What grows has room to spare; the plant's string shall have what it needs.
        ModuleString& piece = scratch.pieces[0];
        GrowingString out(piece, input, bytes, GrowingString::Room::lent);
        run_in_order(input, scratch, machines.local(), services, out, limit);
        make_room(input, to, piece.size(), piece.parameters.size(), bytes_before(input));
        return copy_piece(piece, to, 0, 0);
    }
    if (input.model.serial()) {
        GrowingString out(to, input, bytes);
        return run_in_order(input, scratch, machines.local(), services, out, limit);
    }
    for_each_chunk(scratch.chunks, machines, [&](Chunk& chunk, Machine& machine) {
        GrowingString out(scratch.pieces[static_cast<std::size_t>(&chunk - scratch.chunks.data())], input, bytes);
        OnePass pass(input, machine, services, out);
        pass.run(chunk.begin, chunk.end, chunk.parameters_at);
        if (pass.reached_limit()) limit = true;
    });
    join(input, scratch, machines, to, bytes);
}

}  // namespace espalier
