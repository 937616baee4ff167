// What is saved keeps its meaning, and what other programs write is neither overlooked nor overwritten.
#include "session_fixture.h"
#include "studio/document/plain_name.h"
#include "studio/document/saved_places.h"

using namespace studio_test;

namespace {

namespace fs = std::filesystem;

const char* const model = R"(#include "../lengths.h"
lsystem: 1
derivation length: 3
axiom: A
A --> F(LENGTH)A
endlsystem
)";

/// A library whose model reads a file of the folder above, and a folder of one's own that is open.
struct Shelf : OpenStudio {
    Shelf() : OpenStudio("lsystem: 1\nderivation length: 1\naxiom: F\nendlsystem\n", "own.l") {
        fs::create_directories(library.path() / "models/trees");
        library.write("models/lengths.h", "#define LENGTH 2\n");
        library.write("models/trees/stalk.v", "angle increment: 30\n");
        stalk = library.write("models/trees/stalk.l", model);
        library.write("models/stalk.toml", "[[plant]]\nmodel = \"trees/stalk.l\"\nview = \"trees/stalk.v\"\n");
        fs::create_directories(library.path() / "environments");
        library.write("environments/outer.toml", "[[plant]]\nmodel = \"../models/trees/stalk.l\"\n");
        options.library_folder = library.path();
    }

    Json save(const std::string& path) { return ask({{"do", "save"}, {"path", path}}); }
    /// The last packet without the number of its growth.
    std::string picture() const { return page.packets.back().substr(8); }

    TemporaryFolder library;
    fs::path stalk;
};

const Json& text_named(const Json& document, const std::string& name) {
    for (const Json& text : document["texts"]) {
        if (fs::path(text["path"].get<std::string>()).filename() == name) return text;
    }
    throw std::runtime_error("there is no text " + name);
}

/// One's own model, with another that it includes.
struct Written : OpenStudio {
    Written()
        : OpenStudio(
              "#include \"part.h\"\nlsystem: 1\nderivation length: 2\naxiom: A\nA --> F(LENGTH)A\nendlsystem\n") {
        part = folder.write("part.h", "#define LENGTH 2\n");
        begin();
        wait_until_grown();
    }
    Json part_told() const { return text_named(page.last("document"), "part.h"); }

    fs::path part;
};

}  // namespace

TEST_CASE("what reads files of folders above is saved with them at their relative places", "[studio]") {
    const auto [file, name, place] = GENERATE(table<std::string, std::string, std::string>(
        {{"models/trees/stalk.l", "mine.l", "mine/trees/mine.l"},
         {"models/trees/stalk.l", "kept/mine.l", "kept/mine.l"},
         {"environments/outer.toml", "mine.toml", "mine/environments/mine.toml"},
         {"models/stalk.toml", "mine.toml", "mine.toml"}}));
    INFO(place);
    Shelf studio;
    studio.options.opened.path = studio.library.path() / file;
    studio.begin();
    studio.wait_until_grown();
    const std::string before = studio.picture();
    const Json reply = studio.save(name);
    REQUIRE_FALSE(reply.contains("error"));
    CHECK(reply["path"] == (studio.folder.path() / place).string());
    studio.wait_until_grown();
    CHECK((studio.picture() == before));
    // Nothing of the library is read any more.
    fs::remove_all(studio.library.path());
    studio.change({{"seed", 3}});
    studio.wait_until_grown();
    CHECK(studio.page.last("problems")["problems"].empty());
}

TEST_CASE("every file that models and scenes of the library read may be saved", "[studio]") {
    std::size_t files = 0;
    for (const char* part : {"models", "environments"}) {
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(ESPALIER_SOURCE_DIR) / part)) {
            const fs::path name = entry.path().filename();
            if (!entry.is_regular_file() || name.extension() == ".md") continue;
            INFO(entry.path());
            CHECK(espalier::studio::refusal_of_name(name) == std::nullopt);
            ++files;
        }
    }
    CHECK(files > 250);
    for (const char* picture : {"bark.jpg", "bark.jpeg", "leaf.tif", "leaf.tiff"}) {
        CHECK(espalier::studio::refusal_of_name(picture) == std::nullopt);
    }
}

TEST_CASE("a view file that a model finds by its name follows the name", "[studio]") {
    const std::map<fs::path, std::string> files{{"/m/a/tree.l", ""}, {"/m/a/tree.v", ""}, {"/m/plants.map", ""}};
    const auto places = espalier::studio::saved_places("/m/a/tree.l", files, "/own/x/oak.l", "/own");
    CHECK(places == std::map<fs::path, fs::path>{{"/m/a/tree.l", "/own/x/oak.l"},
                                                 {"/m/a/tree.v", "/own/x/oak.v"},
                                                 {"/m/plants.map", "/own/plants.map"}});
    const auto beside = espalier::studio::saved_places("/m/a/tree.l", files, "/m/a/oak.l", "/m");
    CHECK(beside == std::map<fs::path, fs::path>{{"/m/a/tree.l", "/m/a/oak.l"}, {"/m/a/tree.v", "/m/a/oak.v"}});
}

TEST_CASE("saving under another name replaces no other file", "[studio]") {
    Shelf studio;
    studio.options.opened.path = studio.stalk;
    studio.begin();
    studio.wait_until_grown();
    fs::create_directories(studio.folder.path() / "mine");
    const fs::path other = studio.folder.write("mine/lengths.h", "#define LENGTH 5\n");
    CHECK(studio.save("mine.l")["error"] ==
          other.string() + " is there already, and is another file: save into another folder");
    CHECK_FALSE(fs::exists(studio.folder.path() / "mine/trees"));
    CHECK(text_of(other) == "#define LENGTH 5\n");
}

TEST_CASE("unsaved changes of files that stay where they are stay unsaved under the new name", "[studio]") {
    Written studio;
    studio.change({{"texts", {{studio.part.string(), "#define LENGTH 4\n"}}}});
    CHECK_FALSE(studio.ask({{"do", "save"}, {"path", "other.l"}}).contains("error"));
    studio.wait_until_grown();
    CHECK(text_of(studio.part) == "#define LENGTH 2\n");
    CHECK(studio.part_told()["content"] == "#define LENGTH 4\n");
    CHECK(studio.part_told()["changed"] == true);
}

TEST_CASE("what another program writes is read again, grows, and can be undone", "[studio]") {
    Written studio;
    studio.folder.write("part.h", "#define LENGTH 40\n");
    studio.wait([&] { return studio.part_told()["content"] == "#define LENGTH 40\n"; });
    studio.wait_until_grown();
    CHECK(number_at<float>(studio.page.packets.back(), 48) == Approx(80));
    CHECK(studio.part_told()["changed"] == false);
    CHECK(studio.page.last("message")["text"] == "Another program has written part.h: it has been read again.");
    studio.ask({{"do", "undo"}});
    CHECK(studio.part_told()["content"] == "#define LENGTH 2\n");
    CHECK(studio.part_told()["changed"] == true);
}

TEST_CASE("a text that was changed here and by another program is saved only once it was said which is to stay",
          "[studio]") {
    Written studio;
    studio.change({{"texts", {{studio.part.string(), "#define LENGTH 4\n"}}}});
    studio.folder.write("part.h", "#define LENGTH 40\n");
    const Json refused = studio.ask({{"do", "save"}});
    CHECK(refused["error"] == "another program has written part.h: say first which text is to stay");
    CHECK(text_of(studio.part) == "#define LENGTH 40\n");
    CHECK(studio.part_told()["disputed"] == true);
    CHECK(studio.part_told()["disk"] == "#define LENGTH 40\n");
    SECTION("that of the page") {
        studio.ask({{"do", "settle"}, {"path", studio.part.string()}, {"take", "mine"}});
        CHECK(studio.part_told()["disputed"] == false);
        CHECK_FALSE(studio.part_told().contains("disk"));
        CHECK_FALSE(studio.ask({{"do", "save"}}).contains("error"));
        CHECK(text_of(studio.part) == "#define LENGTH 4\n");
    }
    SECTION("that of the file") {
        studio.ask({{"do", "settle"}, {"path", studio.part.string()}, {"take", "disk"}});
        CHECK(studio.part_told()["content"] == "#define LENGTH 40\n");
        CHECK(studio.part_told()["disputed"] == false);
        CHECK_FALSE(studio.ask({{"do", "save"}}).contains("error"));
        CHECK(text_of(studio.part) == "#define LENGTH 40\n");
    }
}

TEST_CASE("what was written while no studio ran is not overwritten by unsaved work of the last one", "[studio]") {
    Written studio;
    studio.options.state = studio.scratch.path() / "state.json";
    studio.page.texts.clear();
    studio.begin();
    studio.wait_until_grown();
    REQUIRE_FALSE(studio.change({{"texts", {{studio.part.string(), "#define LENGTH 4\n"}}}}).contains("error"));
    studio.session->tick();
    studio.session.reset();
    studio.folder.write("part.h", "#define LENGTH 40\n");
    studio.page.texts.clear();
    studio.begin();
    studio.wait_until_grown();
    CHECK(studio.part_told()["content"] == "#define LENGTH 4\n");
    studio.wait([&] { return studio.part_told()["disputed"] == true; });
}
