// The instances of sub-L-systems that live in a string: each occurrence of ?(id) owns variables.
#pragma once

#include "base/bytes.h"
#include "lsystem/derive/scopes.h"

#include <map>
#include <utility>
#include <vector>

namespace espalier::lsystem {

void put_variables(std::ostream& out, const Variables& variables);
/// Throws RunError if they are not of the same model.
void get_variables(std::istream& in, Variables& variables);

/// An instance is known by the identity of its `?`, which a rewritten module hands on.
class SubSystems {
public:
    /// Null if the scope has none yet.
    Variables* find(const Scope& scope);
    const Variables* find(const Scope& scope) const;
    /// Throws RunError if the arrays of those made in this step take more than the memory.
    Variables& make(const Scope& scope, std::size_t memory);
    /// The variables of a scope, with what it borrows from those around it; null if it or one of them has none.
    Variables* lend(const std::vector<Scope>& scopes, std::uint32_t scope, Variables& main);
    void erase(const Scope& scope);
    void clear();
    void begin_step() { made_ = 0; }
    std::size_t bytes() const { return bytes_; }  ///< bytes of arrays

    void save(std::ostream& out) const;
    void restore(std::istream& in, const CompiledModel& model);

private:
    using Key = std::pair<Identity, std::size_t>;  // identity of the `?`, and which L-system
    static Key key(const Scope& scope) { return {scope.identity, scope.system->index}; }

    std::map<Key, Variables> instances_;
    std::size_t bytes_ = 0, made_ = 0;
};

}  // namespace espalier::lsystem
