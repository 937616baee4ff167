// The one file that holds toml++, which on a machine is a library.
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
