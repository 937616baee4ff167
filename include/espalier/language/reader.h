// Reads a model file (the cpfg language and Espalier's additions).
#pragma once

#include "espalier/base/error.h"
#include "espalier/base/stations.h"
#include "espalier/lsystem/lsystem.h"

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::language {

/// #define overrides: NAME -> text. They win over the file's own #define of the same name.
using Defines = std::map<std::string, std::string>;

struct ReadOptions {
    Defines defines;
    /// Those of `defines` that stand for functions of the step, whose values the reader does not know.
    std::set<std::string> in_time = {};
    Arithmetic arithmetic = Arithmetic::double_precision;
    /// Names defined before the file is read, whether it mentions them or not (the functions of a function set).
    Defines predefined = {};
    /// What func(), curveX() and their like ask; null if there is nothing.
    std::shared_ptr<const Resources> resources = nullptr;
    /// Where warnings go (macros defined twice, variables that are never assigned); none are kept if null.
    std::vector<Diagnostic>* warnings = nullptr;
};

/// Reads a model file. Throws UserError with every mistake found (up to 20), each with file:line:column as the user
/// wrote it, through #include and #define, and the line of text. Overriding a name the file never mentions is an error.
std::shared_ptr<const Model> read_model(const std::filesystem::path& path, const ReadOptions& options = {});
/// The same from text; `name` stands in messages, `folder` is where #include looks.
std::shared_ptr<const Model> read_model_text(std::string_view text, const std::string& name,
                                             const std::filesystem::path& folder = {}, const ReadOptions& options = {});

/// What a model does not say itself.
struct ReviewOptions {
    /// Symbols that the turtle knows, such as "@o", and the numbers of parameters on which they act; none: on any.
    std::map<std::string, std::vector<int>, std::less<>> turtle = {};
    /// Modules that are put into the string while it grows.
    std::set<LetterId> inserted = {};
};

/// What is legal in a model and looks wrong: productions that can never apply, modules that are never produced,
/// unmatched brackets, numbers of parameters that no production takes, `consider` lists without brackets together with
/// right contexts, homomorphism cycles, queries without a process. In the order of their places.
std::vector<Diagnostic> review(const Model& model, const ReviewOptions& options);

}  // namespace espalier::language
