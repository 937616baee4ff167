// The reference and the pages of models are what the parts say.
#include "catch.h"
#include "page.h"
#include "temporary_folder.h"

using Catch::Contains;

namespace {

using namespace pages;

struct Checked {
    int code;
    std::string said;
};

/// `espalier list --markdown docs --check`, in a folder.
Checked check_reference(const fs::path& folder) {
    const TemporaryFolder logs;
    const fs::path log = logs.path() / "log";
    const std::string command = "cd '" + folder.string() +
                                "' && '" ESPALIER_PROGRAM "' list --markdown docs --check >'" + log.string() + "' 2>&1";
    const int code = WEXITSTATUS(std::system(command.c_str()));
    return {code, text_of(log)};
}

}  // namespace

TEST_CASE("The pages of parts and models are what these say; if not: espalier list --markdown docs", "[docs]") {
    const Checked checked = check_reference(root);
    INFO(checked.said);
    CHECK(checked.code == 0);
}

TEST_CASE("A page that is changed, missing or left over is named with the command that mends it", "[docs]") {
    const TemporaryFolder folder;
    for (const char* part : {"models", "environments", "docs"}) {
        fs::copy(root / part, folder.path() / part, fs::copy_options::recursive);
    }
    const fs::path reference = folder.path() / "docs/reference";
    std::ofstream(reference / "processes/cohen.md", std::ios::app) << "Another sentence.\n";
    fs::remove(reference / "stages/stem.md");
    fs::copy(reference / "stages/sway.md", reference / "stages/gone.md");
    const Checked checked = check_reference(folder.path());
    CHECK(checked.code == 1);
    CHECK_THAT(checked.said, Contains("docs/reference/processes/cohen.md") && Contains("not what the parts say") &&
                                 Contains("docs/reference/stages/stem.md") && Contains("missing") &&
                                 Contains("docs/reference/stages/gone.md") && Contains("is gone") &&
                                 Contains("espalier list --markdown docs"));
    CHECK(std::system(
              ("cd '" + folder.path().string() + "' && '" ESPALIER_PROGRAM "' list --markdown docs >log").c_str()) ==
          0);
    CHECK(check_reference(folder.path()).code == 0);
    CHECK_FALSE(fs::exists(reference / "stages/gone.md"));
}
