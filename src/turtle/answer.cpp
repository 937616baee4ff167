// The turtle's own answers reach the string.
#include "espalier/turtle/interpretation.h"

namespace espalier::turtle {

void write_turtle_answers(std::span<const TurtleAnswer> answers, std::span<const TurtleDirection> directions,
                          ModuleString& string) {
    double* const parameters = string.parameters.data();
    for (const TurtleAnswer& answer : answers) {
        // One by one: for a loop of no fixed length a library would be called.
        double* const to = parameters + answer.parameters_at;
        if (answer.count > 0) to[0] = answer.position.x;
        if (answer.count > 1) to[1] = answer.position.y;
        if (answer.count > 2) to[2] = answer.position.z;
    }
    for (const TurtleDirection& direction : directions) {
        for (std::size_t k = 0; k < direction.count; ++k) parameters[direction.parameters_at + k] = direction.values[k];
    }
}

void write_turtle_answers(const Interpretation& interpretation, ModuleString& string) {
    write_turtle_answers(interpretation.answers, interpretation.directions, string);
}

}  // namespace espalier::turtle
