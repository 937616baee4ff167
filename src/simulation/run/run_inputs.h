// The files a run has read, as run.json keeps them.
#pragma once

#include "espalier/base/read_log.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace espalier::simulation {

/// Text as it is, other bytes in hexadecimal digits; of files too large to keep only path, size and digest.
/// Files below `output` are left out: the run wrote them itself.
nlohmann::ordered_json inputs_json(const ReadLog* inputs, const std::filesystem::path& output);

/// The bytes of one of them. Throws nlohmann::json::exception for what is no input.
ReadLog::File input_of(const nlohmann::ordered_json& json);

}  // namespace espalier::simulation
