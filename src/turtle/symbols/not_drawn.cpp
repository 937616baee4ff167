// Symbols that belong to the language and draw nothing here. They are named so that their letters are not taken for
// something else: the F in @Tf does not move.
#include "espalier/turtle/symbol.h"

namespace espalier {
namespace {

void nothing(Walk&, std::span<const double>) {}

const Symbol cylinder_start{"@Gs", {}, "@Gs: start of a generalized cylinder; not drawn", nothing};
const Symbol cylinder_point{"@Gc", {}, "@Gc(n): control point of a generalized cylinder; not drawn", nothing};
const Symbol cylinder_end{"@Ge", {}, "@Ge(n): end of a generalized cylinder; not drawn", nothing};
const Symbol tangents{"@Gt", {}, "@Gt(a, b): tangents of a generalized cylinder; not drawn", nothing};
const Symbol radius_tangents{"@Gr", {}, "@Gr(a, l): radius tangents of a generalized cylinder; not drawn", nothing};
const Symbol contour{"@#", {}, "@#(id): cross-section of generalized cylinders; not drawn", nothing};
const Symbol contour_sides{"@!", {}, "@!(n): polygons around a cylinder; not drawn", nothing};
const Symbol patch_start{"@PS", {}, "@PS(id, type): start of a surface patch; not drawn", nothing};
const Symbol patch_point{"@PC", {}, "@PC(id, r, c): control point of a surface patch; not drawn", nothing};
const Symbol patch{"@PD", {}, "@PD(id, s, t): a surface patch; not drawn", nothing};
const Symbol texture{"@Tx", {}, "@Tx(id): texture; not drawn", nothing};
const Symbol twist_point{"@Tp", {}, "@Tp: twist of generalized cylinders; not drawn", nothing};
const Symbol twist_frame{"@Tf", {}, "@Tf: twist of generalized cylinders; not drawn", nothing};
const Symbol label{"@L", {}, "@L(\"format\", ...): a label; not drawn", nothing};
const Symbol command{"@S", {}, "@S(\"command\"): a shell command; never run", nothing};
const Symbol old_i{"@I", {}, "@I: an old symbol; draws nothing", nothing};
const Symbol old_j{"@J", {}, "@J: an old symbol; draws nothing", nothing};
const Symbol old_mo{"@mo", {}, "@mo: an old symbol; draws nothing", nothing};
const Symbol old_mc{"@mc", {}, "@mc: an old symbol; draws nothing", nothing};
const Symbol unknown{"@*", {}, "@x: unless listed, skipped together with its second character", nothing};

}  // namespace
}  // namespace espalier
