// A link carries a document with all that it reads, and leaves out what comes with the program.
#include "session_fixture.h"

using namespace studio_test;

namespace {

namespace fs = std::filesystem;

const char* const shared_model =
    "#define LENGTH 2\nlsystem: 1\nderivation length: 3\naxiom: A\nA --> F(LENGTH)A\nendlsystem\n";
const char* const shared_scene = "[[plant]]\nmodel = \"../models/stalk.l\"\nview = \"view.v\"\n";

/// A library with a scene, its model and a view file, and a folder of one's own that is open.
struct SharedShelf : OpenStudio {
    SharedShelf() : OpenStudio(shared_model, "own.l") {
        fs::create_directories(library.path() / "models");
        fs::create_directories(library.path() / "environments");
        library.write("models/stalk.l", shared_model);
        library.write("environments/view.v", "angle increment: 30\n");
        options.library_folder = library.path();
        options.library = [this] { return std::vector<espalier::studio::LibraryEntry>{{scene_file, "stalk", ""}}; };
        scene_file = library.write("environments/stalk.toml", shared_scene);
        options.opened.path = scene_file;
    }

    TemporaryFolder library;
    fs::path scene_file;
};

}  // namespace

TEST_CASE("a link names what comes with the program, and holds what was changed", "[studio]") {
    SharedShelf studio;
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    studio.change({{"settings", {{"stalk.l:LENGTH", "3"}}}, {"seed", 7}});
    studio.wait_until_grown();
    Json shared = studio.ask({{"do", "share"}});
    REQUIRE(shared["files"].size() == 3);
    CHECK(shared["main"] == "environments/stalk.toml");
    CHECK(shared["seed"] == 7);
    CHECK_FALSE(shared.contains("steps"));  // the texts say them
    CHECK(shared["files"][0]["library"] == "environments/stalk.toml");
    CHECK_FALSE(shared["files"][0].contains("content"));
    CHECK(shared["files"][2]["path"] == "models/stalk.l");
    CHECK(shared["files"][2]["content"].get<std::string>().find("LENGTH 3") != std::string::npos);

    // Somebody else opens it.
    const std::string picture = page.packets.back().substr(8);
    shared["do"] = "open-text";
    studio.ask(shared);
    studio.wait_until_grown();
    CHECK(page.last("document")["path"] == (studio.folder.path() / "shared/stalk/environments/stalk.toml").string());
    CHECK(page.last("document")["seed"] == 7);
    CHECK((page.packets.back().substr(8) == picture));
    CHECK(text_of(studio.folder.path() / "shared/stalk/environments/view.v") == "angle increment: 30\n");
    studio.change({{"steps", 2}});
    CHECK(studio.ask({{"do", "share"}})["steps"] == 2);
}

TEST_CASE("a model alone becomes one file of a folder of its own", "[studio]") {
    SharedShelf studio;
    studio.options.opened.path = studio.file;
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    Json shared = studio.ask({{"do", "share"}});
    CHECK(shared["main"] == "own.l");
    CHECK(shared["files"] == Json::array({{{"path", "own.l"}, {"content", shared_model}}}));
    for (const char* const place : {"shared/own/own.l", "shared/own-2/own.l"}) {
        shared["do"] = "read-link";
        const Json contents = studio.ask(shared);
        CHECK(contents["folder"] == (studio.folder.path() / place).parent_path().string());
        CHECK(contents["files"] ==
              Json::array({{{"path", "own.l"}, {"bytes", std::string(shared_model).size()}, {"library", nullptr}}}));
        CHECK_FALSE(fs::exists(studio.folder.path() / place));
        shared["do"] = "open-text";
        studio.ask(shared);
        studio.wait_until_grown();
        CHECK(page.last("document")["path"] == (studio.folder.path() / place).string());
        CHECK(text_of(studio.folder.path() / place) == shared_model);
    }
}

TEST_CASE("a link that leads out of the folder, or needs another library, is refused and writes nothing", "[studio]") {
    SharedShelf studio;
    studio.begin();
    studio.wait_until_grown();
    const Json good = {{"path", "a.l"}, {"content", shared_model}};
    const auto refusal = [&](const std::string& main, const Json& files) {
        const Json reply = studio.ask({{"do", "open-text"}, {"main", main}, {"files", files}});
        return reply.value("error", "");
    };
    CHECK(refusal("../a.l", Json::array({good})) == "'../a.l' cannot be written: it leads out of the folder");
    CHECK(refusal("/a.l", Json::array({good})) == "'/a.l' cannot be written: it leads out of the folder");
    CHECK(refusal("a.l", Json::array({good, {{"path", "b/../../b.l"}, {"content", ""}}})) ==
          "'../b.l' cannot be written: it leads out of the folder");
    CHECK(refusal("b.l", Json::array({good})) == "the link holds no model");
    CHECK(refusal("a.l", Json::array()) == "the link holds no model");
    const Json other = {{"path", "b.l"}, {"library", "models/stalk.l"}, {"digest", "0"}};
    CHECK(refusal("a.l", Json::array({good, other})).starts_with("the link needs models/stalk.l of the library"));
    const Json secret = {{"path", "b.l"}, {"library", "../../etc/hostname"}, {"digest", "0"}};
    CHECK(refusal("a.l", Json::array({good, secret})) ==
          "'../../etc/hostname' cannot be written: it leads out of the folder");
    const Json elsewhere = {{"path", "b.l"}, {"library", "docs/b.l"}, {"digest", "0"}};
    CHECK(refusal("a.l", Json::array({good, elsewhere})).starts_with("the link needs docs/b.l of the library"));
    CHECK_FALSE(fs::exists(studio.folder.path() / "a.l"));
    CHECK_FALSE(fs::exists(studio.folder.path() / "shared"));
}
