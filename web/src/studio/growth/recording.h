// A recorded run, which a page does not open: it would have to read files of VTK.
#pragma once

#include "espalier/base/error.h"

#include "studio/growth/growth.h"
#include "studio/growth/plant_source.h"
#include "studio/growth/workers.h"

namespace espalier::studio {

class Recording final : public PlantSource {
public:
    /// Throws UserError.
    [[noreturn]] Recording(GrowthOrder, GrowthListener&, Workers&) { refuse(); }

    std::uint32_t number() const override { return 0; }
    std::uint64_t version() const override { return 0; }
    const Opened& opened() const override { refuse(); }
    double seconds() const override { return 0; }
    bool has(int) const override { return false; }
    bool has_packet(int) const override { return false; }
    void draw(int) override {}
    std::string packet(int) const override { refuse(); }
    LimbAxes limb_axes(int) const override { refuse(); }
    std::vector<std::string> shapes() const override { return {}; }
    std::vector<BrowserTexture> textures() const override { return {}; }
    std::vector<std::string> column_names() const override { return {}; }
    std::string column(int, const std::string&) const override { refuse(); }
    Picked module_info(int, std::uint32_t) const override { refuse(); }
    std::string field(int, const std::string&) const override { refuse(); }
    void cancel() override {}
    bool has_ended() const override { return true; }

private:
    [[noreturn]] static void refuse() {
        throw UserError(
            "a page cannot open a recorded run: `espalier studio` does, and `espalier share` makes a page "
            "of it");
    }
};

}  // namespace espalier::studio
