// The light of a luminaire as its maker publishes it: files of IES LM-63.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::environment {

/// Candela over the angle from the axis and round it, photometric type C. LM-63-1995 and -2002, section 5: the angles
/// round the axis begin at 0 and end at 0 (the same all round), 90 (four quadrants alike), 180 (two halves alike) or
/// later (the whole circle, which need not be closed); or they go from 90 to 270, whose other half mirrors them.
class IesFile {
public:
    /// Throws UserError naming the file and what to change.
    explicit IesFile(const std::filesystem::path& path);

    /// `down` and `turn` in degrees, 0 to 180 and 0 to 360; 0 where the file has no vertical angle.
    double intensity(double down, double turn) const;
    /// What the file says that has no effect, a sentence each.
    const std::vector<std::string>& unused() const { return unused_; }

private:
    void close_circle();
    double within_file(double turn) const;
    [[noreturn]] void refuse(const std::string& why) const;

    std::filesystem::path path_;
    std::vector<double> down_, round_;          ///< degrees, rising
    std::vector<std::vector<double>> candela_;  ///< by angle round the axis, then by the one from it
    std::vector<std::string> unused_;
};

}  // namespace espalier::environment
