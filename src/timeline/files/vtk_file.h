// VTK's XML files as the timeline writes them: inline compressed data, the same bytes for the same content.
#pragma once

#include "timeline/files/inline_data.h"

#include <cstdint>
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::timeline {

/// A file in the making: elements are opened and closed around arrays. It keeps its memory from file to file.
/// VTK's own writers compress in small blocks and put the result into a stream three bytes at a time, which takes ten
/// times as long.
class VtkFile {
public:
    explicit VtkFile(Compression compression = Compression::lz4) : compression_(compression) {}

    /// Forgets the file before. `type` is VTK's name of the kind of data set, "PolyData".
    void begin(std::string_view type);
    /// The same where arrays say whether they have changed since that file: those that have not keep their text.
    void begin_after(std::string_view type);
    void open(std::string_view element, std::string_view attributes = {});
    void close();
    /// The array's memory is the caller's until the file is written.
    void add(const DataArray& array);
    /// The data set's points. Throws RunError for one that 32 bits cannot place: what grows has 64.
    void add_points(const DataArray& points);
    /// Texts that travel with the data set.
    void add_texts(const std::string& name, const std::vector<std::string>& texts);
    /// What ParaView shows as the time of a file opened without its index.
    void add_time(double time, int step);

    /// Closes what is open, compresses the arrays, on several threads if they are large, and writes the file: complete
    /// or not at all. Throws RunError.
    void write(const std::filesystem::path& path);
    /// Returns the digest of what write() would write.
    std::uint64_t digest();

private:
    struct Part {
        std::string markup;  ///< before the array
        DataArray array;
        std::string values;    ///< the array's, unless they are kept elsewhere
        Column<char> text;     ///< the array, encoded
        bool encoded = false;  ///< the text is that of the array

        void own(std::string bytes) {
            values = std::move(bytes);
            array.values = values.data();
        }
    };

    Part& add(std::string_view element, const DataArray& array, std::size_t tuples);
    void encode_all();
    /// Returns the pieces of the whole file; valid until it is begun anew.
    std::vector<std::string_view> pieces();

    Compression compression_;
    std::vector<std::string> open_;
    std::string markup_;      ///< since the last array
    std::deque<Part> parts_;  ///< the first `count_` are of this file
    std::size_t count_ = 0;
    bool after_ = false;  ///< the arrays of the file before can be compared with
};

}  // namespace espalier::timeline
