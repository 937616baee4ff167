// The symbols of modules: one code point each, or a name the model declares.
#pragma once

#include "language/text/source.h"

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::language {

class Symbols {
public:
    void declare(const std::string& name);
    void declare_arity(const std::string& name, std::size_t arity) { arities_[name].push_back(arity); }
    /// The symbol that stands at the beginning of `text`, the longest declared name first; "" if none can.
    std::string_view at(std::string_view text) const;
    /// The numbers of parameters a symbol was declared with, or null.
    const std::vector<std::size_t>* declared_arities(std::string_view name) const;

private:
    std::set<std::string, std::less<>> declared_;
    std::map<char, std::set<std::size_t, std::greater<>>> lengths_;  // lengths of declared names, by first character
    std::map<std::string, std::vector<std::size_t>, std::less<>> arities_;
};

}  // namespace espalier::language
