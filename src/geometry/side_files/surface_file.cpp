#include "espalier/base/file.h"

#include "base/text_cursor.h"
#include "geometry/side_files/side_files.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace espalier::geometry {
namespace {

constexpr std::size_t most_patches = 64;  // as in cpfg
constexpr int most_precision = 10;

/// The file ends within a patch.
struct Truncated {};

struct NamedNeighbours {
    TextCursor place;
    std::array<std::string, 8> names;
};

constexpr std::array<const char*, 8> neighbour_keys{"AL:", "A:", "AR:", "L:", "R:", "BL:", "B:", "BR:"};

/// Where the file puts the surface, before it is placed.
struct Placement {
    glm::dvec3 contact, end, heading, up;
    double size;
};

class SurfaceReader {
public:
    SurfaceReader(std::string_view text, const std::string& name, std::vector<Diagnostic>& diagnostics)
        : text_(text, name), diagnostics_(diagnostics) {}

    std::optional<Surface> read(double size) {
        const Placement placement = read_file();
        if (!link_neighbours()) return std::nullopt;
        place(placement, size / placement.size);
        return std::move(surface_);
    }

    std::vector<ControlPoints> read_points() {
        read_file();
        return std::move(points_);
    }

private:
    Placement read_file() {
        Placement placement;
        try {
            placement = read_header();
        } catch (const Truncated&) {
            text_.fail("the file ends before its first patch");
        }
        read_patches();
        return placement;
    }

    void skip() { text_.skip(TextCursor::white_space); }

    void expect(std::string_view literal) {
        skip();
        if (text_.rest() != literal && literal.starts_with(text_.rest())) throw Truncated();
        if (!text_.accept(literal)) text_.fail(fmt::format("'{}' is expected here", literal));
    }
    double number() {
        skip();
        if (text_.at_end()) throw Truncated();
        const std::optional<double> number = text_.number();
        if (!number) text_.fail(fmt::format("'{}' is no number", TextCursor(text_).word()));
        return *number;
    }
    int integer() {
        skip();
        if (text_.at_end()) throw Truncated();
        const std::optional<int> number = text_.integer();
        if (!number) text_.fail(fmt::format("'{}' is no whole number", TextCursor(text_).word()));
        return *number;
    }
    std::string word() {
        skip();
        if (text_.at_end()) throw Truncated();
        return std::string(text_.word());
    }
    glm::dvec3 vector(std::initializer_list<std::string_view> keys) {
        for (const std::string_view key : keys) expect(key);
        glm::dvec3 vector;
        constexpr std::array axes{"X:", "Y:", "Z:"};
        for (int axis = 0; axis < 3; ++axis) {
            expect(axes[std::size_t(axis)]);
            vector[axis] = number();
        }
        return vector;
    }
    glm::dvec3 direction(std::string_view key) {
        skip();
        const TextCursor start = text_;
        const glm::dvec3 vector = this->vector({key});
        if (!(glm::length(vector) > 0)) start.fail(fmt::format("{} is a direction, not 0 0 0", key));
        return glm::normalize(vector);
    }

    Placement read_header() {
        for (int bound = 0; bound < 6; ++bound) number();  // not used
        skip();
        if (text_.accept("PRECISION")) {
            expect("S:");
            surface_.precision_s = std::clamp(integer(), 1, most_precision);
            expect("T:");
            integer();
            surface_.precision_t = surface_.precision_s;  // as in cpfg, where S counts for both
        }
        Placement placement;
        placement.contact = vector({"CONTACT", "POINT"});
        placement.end = vector({"END", "POINT"});
        placement.heading = direction("HEADING");
        placement.up = direction("UP");
        expect("SIZE:");
        skip();
        const TextCursor start = text_;
        placement.size = number();
        if (placement.size == 0) start.fail("SIZE must not be 0");
        return placement;
    }

    void read_patches() {
        for (skip(); !text_.at_end(); skip()) {
            const TextCursor start = text_;
            if (surface_.patches.size() == most_patches) {
                start.fail(fmt::format("a surface has at most {} patches", most_patches));
            }
            try {
                NamedNeighbours neighbours{start, {}};
                const BicubicPatch patch = read_patch(neighbours.names);
                surface_.patches.push_back(patch);
                neighbours_.push_back(neighbours);
            } catch (const Truncated&) {
                diagnostics_.push_back(start.diagnostic("the file ends within this patch, which is left out",
                                                        Diagnostic::Severity::warning));
                return;
            }
        }
    }

    BicubicPatch read_patch(std::array<std::string, 8>& neighbours) {
        BicubicPatch patch;
        patch.name = word();
        read_colour("TOP", patch.top_colour, patch.top_diffuse);
        read_colour("BOTTOM", patch.bottom_colour, patch.bottom_diffuse);
        for (std::size_t i = 0; i < neighbours.size(); ++i) {
            expect(neighbour_keys[i]);
            neighbours[i] = word();
        }
        ControlPoints points;
        points.name = patch.name;
        points.spline = Spline::other;
        points.coordinates = 3;
        for (auto& row : patch.points) {
            for (glm::dvec3& point : row) {
                skip();
                const std::size_t from = text_.offset();
                for (int axis = 0; axis < 3; ++axis) point[axis] = number();
                points.add({&point.x, 3}, from, text_.offset());
            }
        }
        points_.push_back(std::move(points));
        return patch;
    }

    void read_colour(std::string_view side, int& colour, double& diffuse) {
        expect(side);
        expect("COLOR:");
        colour = integer();
        expect("DIFFUSE:");
        diffuse = number();
    }

    // Neighbours name each other, or the surface is refused.
    bool link_neighbours() {
        std::map<std::string, int> numbers;
        for (std::size_t i = 0; i < surface_.patches.size(); ++i) numbers.emplace(surface_.patches[i].name, int(i));
        for (std::size_t i = 0; i < surface_.patches.size(); ++i) {
            for (std::size_t side = 0; side < 8; ++side) {
                const std::string& name = neighbours_[i].names[side];
                if (name == "~") continue;
                const auto found = numbers.find(name);
                const std::size_t opposite = 7 - side;
                if (found == numbers.end()) {
                    return refuse(i, fmt::format("there is no patch '{}' to be its neighbour", name));
                }
                if (neighbours_[std::size_t(found->second)].names[opposite] != surface_.patches[i].name) {
                    return refuse(
                        i, fmt::format("patch '{}' does not name this one at '{}'", name, neighbour_keys[opposite]));
                }
                surface_.patches[i].neighbours[side] = found->second;
            }
        }
        return true;
    }

    bool refuse(std::size_t patch, const std::string& why) {
        diagnostics_.push_back(neighbours_[patch].place.diagnostic(why + "; the surface is left out"));
        return false;
    }

    // What cpfg does; a change of frame only if the matrix of the three directions is symmetric.
    void place(const Placement& placement, double scale) {
        const glm::dvec3 left = glm::cross(placement.heading, placement.up);
        const glm::dvec3 up = glm::cross(left, placement.heading);
        const auto placed = [&](const glm::dvec3& point) {
            const glm::dvec3 q = scale * (point - placement.contact);
            return q.x * left + q.y * placement.heading + q.z * up;
        };
        for (BicubicPatch& patch : surface_.patches) {
            for (auto& row : patch.points) {
                for (glm::dvec3& point : row) point = placed(point);
            }
        }
        surface_.end = placed(placement.end);
    }

    TextCursor text_;
    std::vector<Diagnostic>& diagnostics_;
    Surface surface_;
    std::vector<NamedNeighbours> neighbours_;
    std::vector<ControlPoints> points_;
};

}  // namespace

std::optional<Surface> read_surface_text(std::string_view text, const std::string& name, double size,
                                         std::vector<Diagnostic>& diagnostics) {
    return SurfaceReader(text, name, diagnostics).read(size);
}

std::vector<ControlPoints> read_surface_points(std::string_view text, const std::string& name,
                                               std::vector<Diagnostic>& diagnostics) {
    return SurfaceReader(text, name, diagnostics).read_points();
}

std::optional<Surface> read_surface(const std::filesystem::path& path, double size,
                                    std::vector<Diagnostic>& diagnostics) {
    return read_surface_text(read_text(path), path.string(), size, diagnostics);
}

}  // namespace espalier::geometry
