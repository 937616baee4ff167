// Keyframes: values of a model's settings at given times, with a line or a smooth curve between them.
#pragma once

#include "espalier/base/settings.h"
#include "espalier/language/reader.h"
#include "espalier/lsystem/derivation.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace espalier::simulation {

/// One [[plant.keyframes]] or [[keyframes]] table. Before the first time and after the last the value stays.
struct Keyframes {
    std::string name;           ///< name of a #define, or the key of a setting of the scene
    std::vector<double> times;  ///< rising
    std::vector<double> values;
    bool spline = false;  ///< a smooth curve, which stays between its values (Steffen 1990)
    Place place = {};

    double at(double time) const;
    /// The same as an expression of the language of models.
    std::string expression(const std::string& time) const;

private:
    double slope(std::size_t k) const;
};

/// Reads one table, whose key `named` says what has the values.
Keyframes read_keyframes_table(const Settings& table, const char* named);

/// All of a plant; throws UserError for times that do not rise, and for values that a setting of the model refuses.
std::vector<Keyframes> read_keyframes(const Settings& plant, const std::filesystem::path& model);

/// The definitions with the values that keyframes have at a time.
Defines at_time(Defines defines, const std::vector<Keyframes>& keyframes, double time);

/// A model whose settings change, for plants that grow anew in every step. Thread safe.
class ModelInTime {
public:
    using Make = std::function<std::shared_ptr<const CompiledModel>(double time)>;

    ModelInTime(Make make, double dt) : make_(std::move(make)), dt_(dt) {}
    /// A model that is the same at all times: the plant has grown before the first step.
    explicit ModelInTime(std::shared_ptr<const CompiledModel> model) : constant_(std::move(model)) {}

    std::shared_ptr<const CompiledModel> at_step(int step) const { return constant_ ? constant_ : make_(step * dt_); }
    bool is_constant() const { return constant_ != nullptr; }

private:
    std::shared_ptr<const CompiledModel> constant_;
    Make make_;
    double dt_ = 1;
};

}  // namespace espalier::simulation
