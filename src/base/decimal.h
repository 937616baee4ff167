// Numbers as text would carry them, without the text.
#pragma once

namespace espalier {

/// The double that is read from what printf writes for "%.*g" with so many significant digits, at least one.
/// NaN if that takes more than products of whole numbers: print and read then.
double rounded_to_digits(double number, int digits);

/// The same for "%.*f" with so many decimals.
double rounded_to_decimals(double number, int decimals);

}  // namespace espalier
