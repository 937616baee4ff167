// The files of a document as pages know them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace espalier::studio {

constexpr std::size_t most_text = std::size_t(1) << 20;  ///< bytes of a text that pages edit

/// What pages can show as text.
bool is_text(std::string_view bytes);
/// Colour maps and materials are bytes, which travel in base64.
bool is_palette(const std::filesystem::path& file);
/// Numbers in such quantity that users do not edit them as text.
bool is_mesh(const std::filesystem::path& file);
/// What pages get and the kept state holds of a file's bytes.
std::string content_of(const std::filesystem::path& file, const std::string& bytes);
/// The bytes of a file, from what a page sends. Throws UserError for a palette that is not in base64.
std::string bytes_of(const std::filesystem::path& file, const std::string& content);

/// A folder that a run has left.
bool is_run(const std::filesystem::path& folder);

// As docs/developer/studio-protocol.md has them.
std::string language_of(const std::filesystem::path& file);
std::string role_of(const std::filesystem::path& file, const std::filesystem::path& main);
std::string kind_of(const std::filesystem::path& path);

/// None if there is no such file.
std::optional<std::string> text_on_disk(const std::filesystem::path& file);

}  // namespace espalier::studio
