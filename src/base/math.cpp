#include "espalier/base/math.h"

#include <sleef.h>

namespace espalier::math {

double sin(double angle) {
    return Sleef_cinz_sind1_u10purec(angle);
}

double cos(double angle) {
    return Sleef_cinz_cosd1_u10purec(angle);
}

double tan(double angle) {
    return Sleef_cinz_tand1_u10purec(angle);
}

double asin(double sine) {
    return Sleef_cinz_asind1_u10purec(sine);
}

double acos(double cosine) {
    return Sleef_cinz_acosd1_u10purec(cosine);
}

double atan(double tangent) {
    return Sleef_cinz_atand1_u10purec(tangent);
}

double atan2(double y, double x) {
    return Sleef_cinz_atan2d1_u10purec(y, x);
}

SineAndCosine sine_and_cosine(double angle) {
    const Sleef_double_2 both = Sleef_cinz_sincosd1_u10purec(angle);
    return {both.x, both.y};
}

double exp(double x) {
    return Sleef_cinz_expd1_u10purec(x);
}

double log(double x) {
    return Sleef_cinz_logd1_u10purec(x);
}

double log1p(double x) {
    return Sleef_cinz_log1pd1_u10purec(x);
}

double cbrt(double x) {
    return Sleef_cinz_cbrtd1_u10purec(x);
}

double hypot(double x, double y) {
    return Sleef_cinz_hypotd1_u05purec(x, y);
}

double any_power(double x, double y) {
    return Sleef_cinz_powd1_u10purec(x, y);
}

}  // namespace espalier::math
