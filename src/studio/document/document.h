// What the pages of a studio edit, and every state it has been in.
#pragma once

#include "espalier/base/read_log.h"
#include "espalier/studio/studio.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace espalier::studio {

struct DocumentState {
    Opened opened;
    UnsavedTexts unsaved;
};

/// States one after the other; undo and redo go back and forth.
class Document {
public:
    /// Ends a transient change; the next one begins another.
    void change(DocumentState state, const std::string& label, bool transient);
    bool undo();
    bool redo();

    /// A file is about to be written: states that rest on what stands in it keep that as unsaved.
    void keep_text(const std::filesystem::path& file, const std::string& text);

    const DocumentState& now() const { return states_[at_].state; }
    /// Grows with every change, undo and redo.
    std::uint64_t version() const { return version_; }
    /// What undo and redo would take back and bring back; none if there is nothing.
    std::optional<std::string> undo_label() const;
    std::optional<std::string> redo_label() const;
    /// The next change replaces the last one.
    bool is_transient() const { return is_transient_; }
    bool is_open() const { return !now().opened.path.empty(); }

    /// The states, to be kept from one run of the program to the next.
    nlohmann::ordered_json to_json() const;
    /// Throws UserError for what to_json() did not write.
    static Document from_json(const nlohmann::ordered_json& json);

private:
    /// Nothing was open before.
    bool is_first() const;

    struct Entry {
        DocumentState state;
        std::string label;  ///< names the change that led to it
    };

    static constexpr std::size_t most_states = 1000;

    std::vector<Entry> states_{1};
    std::size_t at_ = 0;
    std::uint64_t version_ = 0;
    bool is_transient_ = false;
};

}  // namespace espalier::studio
