// The web site of the manual.
#include "catch.h"
#include "page.h"
#include "temporary_folder.h"

namespace {

using namespace pages;

std::string output_of(const std::string& command, int& code) {
    const TemporaryFolder folder;
    const fs::path log = folder.path() / "log";
    code = WEXITSTATUS(std::system((command + " >'" + log.string() + "' 2>&1").c_str()));
    return text_of(log);
}

/// The pages as Sphinx reads them.
fs::path staged(const fs::path& folder) {
    int code = 0;
    const std::string command =
        "python3 '" + (root / "docs/site/stage.py").string() + "' '" + root.string() + "' '" + folder.string() + "'";
    INFO(output_of(command, code));
    REQUIRE(code == 0);
    return folder;
}

bool has(const std::string& program) {
    return std::system((program + " >/dev/null 2>&1").c_str()) == 0;
}

}  // namespace

TEST_CASE("the site has every page, and its contents are those of the index of the manual", "[docs]") {
    if (!has("python3 --version")) {
        WARN("skipped: no Python");
        return;
    }
    const TemporaryFolder folder;
    const fs::path pages = staged(folder.path() / "pages");
    const std::string first = text_of(pages / "index.md");
    CHECK(first.starts_with("# Espalier\n"));
    for (const char* const page :
         {"docs/first-scene.md", "docs/language.md", "docs/reference/README.md", "docs/studio.md"})
        CHECK(first.find("\n" + std::string(page) + "\n") != std::string::npos);
    for (const fs::path& page : all_pages()) {
        INFO(page.string());
        CHECK((page == "README.md" || fs::exists(pages / page)));
    }
    CHECK(text_of(pages / "docs/README.md").find("](../index.md#a-tree-in-ten-lines)") != std::string::npos);
    CHECK(fs::exists(pages / "models/trees/honda.l"));  // a page links to it
}

TEST_CASE("the site is made without a link that leads nowhere, and can be searched", "[docs]") {
    const char* const python = "/usr/bin/python3";
    if (!has(std::string(python) + " -c 'import sphinx, myst_parser, furo'")) {
        WARN("skipped: no Sphinx with MyST and Furo");
        return;
    }
    // What was read before is kept beside the build: only pages that have changed are read again.
    const fs::path build = ESPALIER_BUILD_DIR;
    const fs::path pages = staged(build / "site-pages");
    int code = 0;
    const std::string said = output_of(std::string(python) + " -m sphinx -q -W --keep-going -b html -d '" +
                                           (build / "site-doctrees").string() + "' '" + pages.string() + "' '" +
                                           (build / "site").string() + "'",
                                       code);
    INFO(said);
    CHECK(code == 0);
    CHECK(text_of(build / "site/searchindex.js").find("dissip") != std::string::npos);
    CHECK(text_of(build / "site/docs/reference/processes/voxel-shade.html").find("<code") != std::string::npos);
}
