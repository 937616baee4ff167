// The texts of a document and the numbers in them that pages may change.
#pragma once

#include "espalier/base/read_log.h"

#include "studio/document/document.h"
#include "studio/document/written_numbers.h"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace espalier::studio {

/// A state of the document holds unsaved texts; all others are as they lie on disk.
std::string text_of(const std::filesystem::path& file, const DocumentState& state);

/// The files that the last growth has read.
class DocumentTexts {
public:
    using Files = std::map<std::filesystem::path, ReadLog::File>;
    /// The file of a number and the number.
    using Placed = std::pair<std::filesystem::path, WrittenNumber>;

    /// `library`: the folder of the models that come with the program.
    explicit DocumentTexts(std::filesystem::path library) : library_(std::move(library)) {}

    const Files& files() const { return read_; }
    /// False if these are the same files with the same texts.
    bool learn(const Files& files);
    void forget() { read_.clear(); }

    /// Those that pages may edit: what was read, and what has unsaved changes.
    std::set<std::filesystem::path> editable(const DocumentState& state) const;
    /// What the document reads, itself among it, as it is now; by absolute paths.
    std::map<std::filesystem::path, std::string> contents(const DocumentState& state) const;

    /// The numbers of the texts by the names that pages know them by.
    std::map<std::string, Placed> numbers(const DocumentState& state) const;
    /// Writes a number into its text; without `text`, what the file on disk says. Throws UserError for an unknown name
    /// and for a text that is no value of it.
    void set_number(const std::string& name, const std::optional<std::string>& text, DocumentState& state) const;

private:
    std::filesystem::path library_;
    Files read_;
};

}  // namespace espalier::studio
