#include "environment/soil/linear/stock.h"

#include "espalier/base/stop.h"

#include "base/bytes.h"
#include "environment/soil/linear/steady.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <iterator>
#include <limits>
#include <ostream>

namespace espalier::environment {
namespace {

double initial_content(const WaterParameters& parameters, const glm::dvec3& point) {
    const WaterLayer* layer = parameters.layer_at(point.y);
    double content = layer && layer->initial ? *layer->initial : parameters.initial;
    for (const WaterRegion& region : parameters.regions) {
        const double distance = region.shape->distance(point);
        if (distance <= 0) {
            content = region.content;
        } else if (distance < region.edge) {
            content = region.content + (content - region.content) * (distance / region.edge);
        }
    }
    return content;
}

}  // namespace

double WaterBalance::relative_error() const {
    const double missing = start + added + boundary - drunk - displaced - runoff - total;
    const double largest = std::max({start, added, std::abs(boundary), drunk, displaced, runoff, total});
    return largest > 0 ? missing / largest : 0;
}

WaterStock::WaterStock(const WaterGrid& grid, const WaterParameters& parameters, std::vector<std::uint8_t> free)
    : grid_(grid), parameters_(parameters), free_(std::move(free)), faces_(grid_, free_) {
    contents_.resize(grid_.cells());
    spare_.resize(grid_.cells());
    paint();
    find_sources();
    measure();
    balance_.start = balance_.total;
}

void WaterStock::paint() {
    std::fill(spare_.begin(), spare_.end(), 0);
    std::fill(contents_.begin(), contents_.end(), 0);
    faces_.for_free(grid_, [&](std::size_t cell) {
        contents_[cell] = initial_content(parameters_, grid_.centre(grid_.voxel_of(cell)));
    });
}

void WaterStock::find_sources() {
    sources_.clear();
    for (const WaterSource& source : parameters_.sources) {
        const std::vector<std::size_t> inside = cells_of_source(grid_, *source.shape, source.place);
        sources_.push_back({source, {}});
        std::copy_if(inside.begin(), inside.end(), std::back_inserter(sources_.back().cells),
                     [&](std::size_t cell) { return faces_.free(cell); });
    }
}

void WaterStock::set_source(std::size_t source, double value) {
    for (WaterSource* changed : {&parameters_.sources[source], &sources_[source].source}) {
        (changed->hold ? *changed->hold : changed->rate) = value;
    }
}

void WaterStock::set_free(std::vector<std::uint8_t> free) {
    free_ = std::move(free);
    faces_ = WaterFaces(grid_, free_);
    grid_.for_each_cell([&](std::size_t cell) {
        if (faces_.free(cell)) return;
        balance_.displaced += contents_[cell];
        contents_[cell] = 0;
    });
    find_sources();
}

void WaterStock::hold() {
    for (const Source& source : sources_) {
        if (!source.source.hold) continue;
        double added = 0;
        for (const std::size_t cell : source.cells) {
            added += *source.source.hold - contents_[cell];
            contents_[cell] = *source.source.hold;
        }
        balance_.added += added;
    }
}

void WaterStock::gain(double dt) {
    for (const Source& source : sources_) {
        if (source.source.hold) continue;
        const double amount = source.source.rate * dt;
        for (const std::size_t cell : source.cells) contents_[cell] += amount;
        balance_.added += amount * static_cast<double>(source.cells.size());
        run_off(source);
    }
}

void WaterStock::run_off(const Source& source) {
    const double full = parameters_.porosity;
    double excess = 0;
    for (const std::size_t cell : source.cells) {
        if (contents_[cell] <= full) continue;
        excess += contents_[cell] - full;
        contents_[cell] = full;
    }
    balance_.runoff += excess;
}

void WaterStock::settle(const WaterDiffusion& diffusion) {
    WaterForcing forcing;
    forcing.held.resize(grid_.cells());
    forcing.gain.resize(grid_.cells());
    hold();
    for (const Source& source : sources_) {
        for (const std::size_t cell : source.cells) {
            if (source.source.hold) forcing.held[cell] = 1;
            forcing.gain[cell] += source.source.rate;
        }
    }
    environment::settle(grid_, faces_, diffusion, forcing, contents_);
    balance_ = {};
    measure();
    balance_.start = balance_.total;
    if (balance_.maximum > parameters_.porosity * (1 + 1e-9)) {
        throw UserError(diffusion.place(),
                        fmt::format("begin = \"steady\": sources would fill the soil to {:.3g}, more "
                                    "than its porosity",
                                    balance_.maximum));
    }
}

void WaterStock::diffuse(WaterDiffusion& diffusion, double dt) {
    const int substeps = diffusion.substeps(dt);
    const double part = dt / substeps;
    hold();
    for (int substep = 0; substep < substeps; ++substep) {
        end_if_asked();
        gain(part);
        balance_.boundary += diffusion.sweep(faces_, contents_, spare_, part);
        contents_.swap(spare_);
        hold();
    }
}

void WaterStock::relax(double dt) {
    hold();
    gain(dt);
    for (int sweep = 0; sweep < parameters_.sweeps; ++sweep) {
        end_if_asked();
        const double change = relaxation_sweep(grid_, faces_, parameters_.relaxation, contents_, spare_);
        contents_.swap(spare_);
        hold();
        if (change <= parameters_.tolerance) break;
    }
}

void WaterStock::measure() {
    struct Figures {
        double sum = 0;
        double minimum = std::numeric_limits<double>::infinity();
        double maximum = -std::numeric_limits<double>::infinity();
    };
    std::vector<Figures> rows(grid_.rows());
    grid_.for_rows([&](std::size_t row) {
        grid_.for_cells_of(row, [&](std::size_t cell) {
            if (!faces_.free(cell)) return;
            rows[row].sum += contents_[cell];
            rows[row].minimum = std::min(rows[row].minimum, contents_[cell]);
            rows[row].maximum = std::max(rows[row].maximum, contents_[cell]);
        });
    });
    Figures all;
    for (const Figures& row : rows) {
        all.sum += row.sum;
        all.minimum = std::min(all.minimum, row.minimum);
        all.maximum = std::max(all.maximum, row.maximum);
    }
    balance_.total = all.sum;
    const bool any = faces_.free_voxels() > 0;
    balance_.minimum = any ? all.minimum : 0;
    balance_.maximum = any ? all.maximum : 0;
}

void WaterStock::save(std::ostream& out) const {
    put(out, grid_.size());
    put(out, balance_);
    out.write(reinterpret_cast<const char*>(free_.data()), static_cast<std::streamsize>(free_.size()));
    for (std::size_t row = 0; row < grid_.rows(); ++row) {
        write_doubles(out, {contents_.data() + grid_.row_begin(row), std::size_t(grid_.size().x)});
    }
}

void WaterStock::restore(std::istream& in) {
    if (get<glm::ivec3>(in) != grid_.size()) throw RunError("the checkpoint's soil has another grid than the scene's");
    balance_ = get<WaterBalance>(in);
    in.read(reinterpret_cast<char*>(free_.data()), static_cast<std::streamsize>(free_.size()));
    faces_ = WaterFaces(grid_, free_);
    for (std::size_t row = 0; row < grid_.rows(); ++row) {
        read_doubles(in, {contents_.data() + grid_.row_begin(row), std::size_t(grid_.size().x)});
    }
    find_sources();
}

}  // namespace espalier::environment
