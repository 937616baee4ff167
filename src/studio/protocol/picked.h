// A module as pages see it that ask what it is.
#pragma once

#include "studio/protocol/declaration.h"

#include <cstdint>

namespace espalier::studio {

struct PickedParent {
    static constexpr TypeName type{"Parent", "the module that a module was born of"};
    std::string identity;
    std::optional<std::string> symbol, text;
    std::optional<std::int64_t> born;
    std::optional<std::size_t> module;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("identity", self.identity, "16 hexadecimal digits");
        field("symbol", self.symbol, "missing if it was born before the first step that is known");
        field("text", self.text, "with its parameters, before the birth");
        field("born", self.born, "step of its own birth");
        field("module", self.module, "its number in this step, if it is still there");
    }
};

struct PickedHistory {
    static constexpr TypeName type{"History", "parameters of a module over time"};
    std::vector<int> steps;
    std::vector<std::vector<Nullable<double>>> parameters;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("steps", self.steps, "at most a hundred since its birth");
        field("parameters", self.parameters, "a row for each step; null if a value is not known");
    }
};

struct PickedDay {
    static constexpr TypeName type{"Day", "what processes know of a module within the day of the step"};
    std::vector<int> steps;
    std::vector<double> hours;
    std::vector<std::string> names, units;
    std::vector<std::vector<Nullable<double>>> values;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("steps", self.steps, "steps of the day in which there was the module");
        field("hours", self.hours, "since the midnight before, at the end of each step");
        field("names", self.names, "what is known, such as leaves.assimilation");
        field("units", self.units, "of each; empty: none is known");
        field("values", self.values, "a row for each name, a value for each step; null where there is none");
    }
};

struct PickedPlace {
    static constexpr TypeName type{"Place", "a place in a text"};
    std::string file;
    int line = 0, column = 0;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("file", self.file, "path of the text");
        field("line", self.line, "from 1 on");
        field("column", self.column, "from 1 on");
    }
};

struct Picked {
    static constexpr TypeName type{"Picked", "what is known of a module; what is missing is not recorded"};
    std::string plant, symbol, text;
    std::vector<std::string> names;
    std::vector<Nullable<double>> parameters;
    std::optional<std::string> identity;
    std::optional<std::int64_t> born;
    std::optional<int> order;
    std::optional<Nullable<PickedParent>> parent;
    std::optional<std::size_t> children;
    std::optional<PickedHistory> history;
    std::optional<PickedDay> day;
    std::optional<std::vector<PickedPlace>> places;
    std::optional<std::vector<std::size_t>> siblings;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("plant", self.plant, "name of its plant");
        field("symbol", self.symbol, "its letter");
        field("text", self.text, "the module with its parameters");
        field("names", self.names, "names of its parameters");
        field("parameters", self.parameters, "values of its parameters");
        field("identity", self.identity, "16 hexadecimal digits");
        field("born", self.born, "step of its birth");
        field("order", self.order, "order of branching, of recorded runs");
        field("parent", self.parent, "null for modules of the axiom");
        field("children", self.children, "modules of this step that were born of it");
        field("history", self.history, "its parameters since its birth");
        field("day", self.day, "the course of its day, where steps are shorter than a quarter of one");
        field("places", self.places, "the productions that may have made it");
        field("siblings", self.siblings, "modules of this step that were born with it");
    }
};

}  // namespace espalier::studio
