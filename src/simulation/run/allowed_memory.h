// How much memory a growth may take, whoever starts it.
#pragma once

#include <cstddef>
#include <filesystem>

namespace espalier::simulation {

/// What came by a link may take so many bytes, unless the user says otherwise.
inline constexpr std::size_t memory_of_links = std::size_t{1} << 30;

/// `asked`: bytes, as the user said; 0: he did not. `what`: the file or folder that grows. `processes`: how many grow
/// it together on this machine.
std::size_t allowed_memory(std::size_t asked, const std::filesystem::path& what, std::size_t processes = 1);

}  // namespace espalier::simulation
