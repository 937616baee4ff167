// OpenVDB files, read grid by grid. OpenVDB believes the lengths and numbers that a file claims; here they are compared
// with the file first, and OpenVDB reads the transforms and trees that are whole.
#pragma once

#include "geometry/grids/vdb_bytes.h"

#include <openvdb/openvdb.h>

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace espalier::geometry {

class VdbFile {
public:
    /// `in` can be searched, and lasts as long as this. `memory`: most bytes that a grid may take. Throws VdbError, as
    /// all do, for what is damaged, of a format from before 2013, or too large.
    VdbFile(std::istream& in, std::uint64_t memory);

    /// In the file's order.
    const std::vector<std::string>& names() const { return names_; }
    /// The first of that name, with the texts and flags of its metadata: of floats, doubles, or vectors of three of
    /// them. Of other types none are read.
    openvdb::GridBase::Ptr read(const std::string& name);

private:
    struct Entry {
        std::string unique_name, type, tree_of;
        std::uint64_t begin = 0;
    };

    void read_header();
    void list_grids();
    const Entry& entry(const std::string& unique_name) const;
    openvdb::GridBase::Ptr read(const Entry& entry);
    openvdb::MetaMap read_metadata();
    std::uint64_t end_of(const Entry& entry);

    VdbBytes file_;
    std::uint64_t memory_;
    std::uint32_t format_ = 0;
    openvdb::VersionId library_;
    bool has_places_ = false;  ///< the file says where each grid ends
    std::vector<Entry> entries_;
    std::vector<std::string> names_;
};

/// A memory limit for whoever has none of his own: that of the machine.
std::uint64_t memory_for_grids();

}  // namespace espalier::geometry
