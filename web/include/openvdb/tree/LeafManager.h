#pragma once

#include <openvdb/openvdb.h>

namespace openvdb::tree {

/// The blocks of a tree by numbers.
template <class Tree>
class LeafManager {
public:
    explicit LeafManager(Tree& tree) {
        leaves_.reserve(tree.leafCount());
        for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) leaves_.push_back(const_cast<FloatLeaf*>(&*leaf));
    }

    std::size_t leafCount() const { return leaves_.size(); }
    FloatLeaf& leaf(std::size_t number) const { return *leaves_[number]; }

private:
    std::vector<FloatLeaf*> leaves_;
};

}  // namespace openvdb::tree
