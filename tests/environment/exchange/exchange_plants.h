// Plants made by hand for exchanges: each asks from given places, without a turtle or a derivation.
#pragma once

#include "espalier/environment/environment.h"
#include "espalier/lsystem/lsystem.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

namespace espalier {

using namespace espalier::environment;

/// One question to come: where it is asked, of which process ("" for ?E) and with what.
struct Asked {
    glm::dvec3 position;
    std::vector<double> parameters;
    std::string process = "light";
};

/// Plants whose strings are nothing but communication modules.
class AskingPlants {
public:
    /// All plants share one model, which declares `declared`.
    explicit AskingPlants(std::vector<std::string> declared = {"light"}) {
        model_.name = "asking.l";
        model_.processes = std::move(declared);
    }

    AskingPlants& add(const std::vector<Asked>& questions) {
        strings_.emplace_back();
        interpretations_.emplace_back();
        ModuleString& string = strings_.back();
        const auto plant = static_cast<std::uint32_t>(strings_.size() - 1);
        for (const Asked& asked : questions) {
            Query query;
            for (std::size_t i = 0; i < model_.processes.size(); ++i) {
                if (model_.processes[i] == asked.process) query.process = static_cast<std::int16_t>(i);
            }
            query.plant = plant;
            query.module = static_cast<std::uint32_t>(string.size());
            query.parameters_at = string.parameters.size();
            query.pose.position = asked.position;
            const std::string symbol = asked.process.empty() ? "E" : "?" + asked.process;
            string.append(model_.alphabet.letter(symbol, static_cast<int>(asked.parameters.size())), asked.parameters);
            interpretations_.back().queries.push_back(query);
        }
        for (std::size_t i = 0; i < questions.size(); ++i) {
            Query& query = interpretations_.back().queries[i];
            query.parameters = {string.parameters.data() + query.parameters_at, questions[i].parameters.size()};
        }
        return *this;
    }

    void exchange(Environment& environment, int step = 0) { exchange(environment, step, nullptr); }

    /// As if the plants were not in memory: their queries come some plants after the other, and do not stay.
    void exchange_waiting(Environment& environment, int step = 0) {
        WaitingQueries waiting;
        for (const Interpretation& one : interpretations_) waiting.count += one.queries.size();
        waiting.of = [&](std::uint32_t plant, QueryColumn& room) -> std::span<const Query> {
            room = interpretations_[plant].queries;
            return room;
        };
        exchange(environment, step, &waiting);
    }

    void exchange(Environment& environment, int step, const WaitingQueries* waiting) {
        std::vector<PlantView> views;
        std::vector<ModuleString*> strings;
        for (std::size_t i = 0; i < strings_.size(); ++i) {
            views.push_back({static_cast<std::uint32_t>(i), &model_, &strings_[i], &interpretations_[i]});
            strings.push_back(&strings_[i]);
        }
        environment.exchange({step, double(step), 1, views, waiting}, strings);
    }

    /// Writes every parameter anew over the answers, as a model does that asks again.
    void ask_again_with(double parameter) {
        for (ModuleString& string : strings_) {
            std::fill(string.parameters.begin(), string.parameters.end(), parameter);
        }
    }

    /// After an exchange: all parameters of a plant's modules, one after the other.
    std::vector<double> parameters(std::size_t plant = 0) const {
        return {strings_[plant].parameters.begin(), strings_[plant].parameters.end()};
    }
    std::size_t count() const { return strings_.size(); }
    Model& model() { return model_; }
    Interpretation& interpretation(std::size_t plant) { return interpretations_[plant]; }

private:
    Model model_;
    std::deque<ModuleString> strings_;  // queries point into them
    std::deque<Interpretation> interpretations_;
};

/// The message of what `action` throws, or "".
inline std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

/// "" if `text` has all `words`, else the text and the first word it lacks.
inline std::string lacks(const std::string& text, std::initializer_list<const char*> words) {
    for (const char* word : words) {
        if (text.find(word) == std::string::npos) return "'" + text + "' lacks '" + word + "'";
    }
    return "";
}

/// An environment of the tables in `toml`, in the file's order.
inline Environment environment_of(const std::string& toml, EnvironmentContext context = {}) {
    const Settings file = Settings::parse_toml(toml, "scene.toml");
    std::vector<std::pair<std::string, Settings>> tables;
    for (const std::string& name : file.keys()) tables.emplace_back(name, file.table(name));
    return Environment(tables, context);
}

}  // namespace espalier
