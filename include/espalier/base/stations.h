// The namespaces of the stations. They are inline: what is declared in `espalier::simulation` is `espalier::World` to
// programs, and two stations may each use one name for a thing of its own.
#pragma once

#ifdef __clang__  // which wants to see "inline" again wherever one of them is opened
#pragma clang diagnostic ignored "-Winline-namespace-reopened-noninline"
#endif

namespace espalier {

inline namespace geometry {}
inline namespace lsystem {}
inline namespace language {}
inline namespace turtle {}
inline namespace environment {}
inline namespace timeline {}
inline namespace simulation {}
inline namespace archive {}
inline namespace analysis {}
inline namespace formats {}
inline namespace picture {}
inline namespace view {}
inline namespace studio {}

}  // namespace espalier
