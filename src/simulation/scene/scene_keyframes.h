// Keyframes of a scene: numbers of its processes, its turtles and its geometry stages that change with time.
#pragma once

#include "espalier/environment/environment.h"
#include "espalier/turtle/geometry_stage.h"
#include "espalier/turtle/turtle.h"

#include "simulation/scene/keyframes.h"

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace espalier::simulation {

/// Settings of a process in time.
class EnvironmentInTime {
public:
    struct Setting {
        std::string process, key;
        Keyframes values;
    };

    explicit EnvironmentInTime(std::vector<Setting> settings) : settings_(std::move(settings)) {}

    /// Throws UserError for settings that do not change, with those that do, or not to these values.
    void check(Environment& environment) const;
    /// Gives the settings their values of a time.
    void set(Environment& environment, double time) const;

private:
    std::vector<Setting> settings_;
};

/// What is drawn of a plant, and how, at one time.
struct Drawing {
    TurtleSettings turtle;  ///< its pose is not set
    GeometryStages stages;
};

/// Drawings of a plant's steps. Thread safe.
class DrawingInTime {
public:
    using Make = std::function<Drawing(double time)>;

    DrawingInTime(Make make, double dt) : make_(std::move(make)), dt_(dt) {}
    std::shared_ptr<const Drawing> at_step(int step) const;

private:
    Make make_;
    double dt_;
    mutable std::mutex mutex_;
    mutable int step_ = -1;  ///< step of the drawing made last: many plants ask for the same
    mutable std::shared_ptr<const Drawing> drawing_;
};

/// The [[keyframes]] tables of a scene.
struct SceneKeyframes {
    std::vector<EnvironmentInTime::Setting> of_processes;
    std::vector<std::vector<Keyframes>> of_plants;  ///< by table; names are keys of that table: "stage.1.tip"
};

/// Throws UserError for keys that cannot change with time.
SceneKeyframes read_scene_keyframes(const Settings& root);

}  // namespace espalier::simulation
