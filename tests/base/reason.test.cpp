#include "base/reason.h"

#include "espalier/base/error.h"

#include "catch.h"

#include <filesystem>
#include <functional>
#include <new>
#include <system_error>

using namespace espalier;
namespace fs = std::filesystem;

namespace {

std::string reason_of_throwing(const std::function<void()>& work) {
    try {
        work();
    } catch (const std::exception& error) {
        return reason_of(error);
    }
    return "nothing was thrown";
}

}  // namespace

TEST_CASE("what the standard library says of files and memory is told in plain words", "[base]") {
    CHECK(reason_of_throwing([] { (void)fs::absolute(""); }) == "the name of a file or folder is empty");
    CHECK(reason_of_throwing([] { (void)fs::file_size("/no/such/file"); }) ==
          "/no/such/file: No such file or directory");
    CHECK(reason_of_throwing([] { throw std::system_error(EACCES, std::generic_category(), "while opening"); }) ==
          "Permission denied");
    CHECK(reason_of_throwing([] { throw std::bad_alloc(); }) == "the machine has no memory left");
}

TEST_CASE("what the library itself says stays as it is", "[base]") {
    CHECK(reason_of_throwing([] { throw RunError("the disk is full"); }) == "the disk is full");
    CHECK(reason_of_throwing([] { throw UserError({"a.l", 3, 4}, "no such module", "x"); }).starts_with("a.l:3:4: "));
}
