// A bound on how deep the parsers call themselves.
#pragma once

#include "language/parser/expressions.h"

namespace espalier::language {

class ExpressionParser::DepthGuard {
public:
    DepthGuard(int& depth, const Scanner& in) : depth_(depth) {
        if (depth_ >= deepest) throw SyntaxError{in.here(), "this is nested too deeply (more than 500 levels)"};
        ++depth_;
    }
    ~DepthGuard() { --depth_; }
    DepthGuard(const DepthGuard&) = delete;
    DepthGuard& operator=(const DepthGuard&) = delete;

private:
    static constexpr int deepest = 500;
    int& depth_;
};

}  // namespace espalier::language
