// What a stranger's link may not do: write files of any name, read what is not its own, or keep the studio from its
// owner. Each attack is refused with a sentence.
#include "session_fixture.h"
#include "studio/document/plain_name.h"
#include "studio/document/sharing.h"

#include <sys/stat.h>

using namespace studio_test;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

const char* const stalk = "lsystem: 1\nderivation length: 1\naxiom: A\nA --> F(1)A\nendlsystem\n";

Json link_of(const std::map<std::string, std::string>& files, const std::string& main) {
    Json list = Json::array();
    for (const auto& [path, content] : files) list.push_back({{"path", path}, {"content", content}});
    return {{"main", main}, {"files", list}};
}

/// A studio on a folder with a secret, into which a link is pasted.
struct Pasted : OpenStudio {
    Pasted() : OpenStudio(stalk) {
        folder.write("secret.txt", "password");
        folder.write("secret.obj", "password\n");
        begin();
        wait_until_grown();
    }

    Json paste(Json link) {
        link["do"] = "open-text";
        return ask(link);
    }
    /// The problems that the growth of the link's main file ends with.
    std::string problems_of(const std::map<std::string, std::string>& files, const std::string& main) {
        const Json before = page.last("problems");
        page.texts.clear();
        const Json reply = paste(link_of(files, main));
        REQUIRE_FALSE(reply.contains("error"));
        wait([&] {
            const Json told = page.last("problems");
            return !told.is_null() && told["version"] == reply["version"];
        });
        return page.last("problems")["problems"].dump();
    }
    bool has_told_secret() const {
        for (const Json& text : page.texts) {
            if (text.dump().find("password") != std::string::npos) return true;
        }
        return false;
    }
};

}  // namespace

TEST_CASE("a link writes no file that a shell or another program takes for its own", "[studio]") {
    Pasted studio;
    const std::vector<std::pair<std::string, std::string>> attacks{
        {".bash_aliases", "names that begin with a dot are hidden files"},
        {".ssh/authorized_keys", "names that begin with a dot are hidden files"},
        {"x/.git/config", "names that begin with a dot are hidden files"},
        {"x/config", "the studio writes models, scenes and side files"},
        {"run.sh", "the studio writes models, scenes and side files"},
        {"Makefile", "the studio writes models, scenes and side files"},
        {"page.html", "the studio writes models, scenes and side files"},
        {"a\nb.l", "it holds characters that cannot be shown"},
        {"a\x1b[2J.l", "it holds characters that cannot be shown"},
        {"a\tb.l", "it holds characters that cannot be shown"},
        {"a\\b.l", "it holds one of the characters"},
        {"c:a.l", "it holds one of the characters"},
        {std::string("honda.l\0.l", 10), "it holds characters that cannot be shown"},
        {"NUL.l", "some systems take it for a device"},
        {"com1.toml", "some systems take it for a device"},
        {"x/aux.v", "some systems take it for a device"},
        {"x./a.l", "it ends in a dot or a space"},
        {"../a.l", "it leads out of the folder"},
        {"/tmp/a.l", "it leads out of the folder"},
        {"a/b/c/d/e/f/g/h/i.l", "folders deep"},
        {std::string(200, 'a') + ".l", "a name has 1 to 128 bytes"}};
    for (const auto& [name, why] : attacks) {
        INFO(name);
        const Json beside = studio.paste(link_of({{"plant.l", stalk}, {name, stalk}}, "plant.l"));
        CHECK_THAT(beside.value("error", ""), Contains("cannot be written: ") && Contains(why));
        const Json alone = studio.paste(link_of({{name, stalk}}, name));
        CHECK_THAT(alone.value("error", ""), Contains("cannot be written: ") && Contains(why));
    }
    CHECK_FALSE(fs::exists(studio.folder.path() / "shared"));
}

TEST_CASE("what pages save and make anew obeys the same list of names", "[studio]") {
    Pasted studio;
    for (const std::string name : {".profile", "x/.git/config", "run.sh", "a\nb.l", "con.l"}) {
        INFO(name);
        CHECK_THAT(studio.ask({{"do", "save"}, {"path", name}}).value("error", ""), Contains("cannot be written"));
        const Json made = studio.ask({{"do", "new-file"}, {"name", name}, {"content", ""}});
        CHECK(made.value("error", "").find("cannot be written") != std::string::npos);
    }
    CHECK_FALSE(studio.ask({{"do", "save"}, {"path", "kept/plant.l"}}).contains("error"));
}

TEST_CASE("names that people give their files are plain", "[studio]") {
    for (const char* const name : {"honda.l", "models/Ahorn groß.l", "a/b/c.toml", "specifications", "leaf.s",
                                   "x.species", "x.pgraph", "x.sdl", "auxin.l", "com.v", "bark.bark", "common.h"}) {
        INFO(name);
        CHECK(espalier::studio::refusal_of_name(name) == std::nullopt);
    }
}

TEST_CASE("a file of a link that includes what is not its own is refused, and nothing of that is told", "[studio]") {
    Pasted studio;
    const std::string secret = (studio.folder.path() / "secret.txt").string();
    for (const std::string& name :
         {std::string("../../secret.txt"), secret, std::string("/proc/self/environ"), std::string("/etc/passwd")}) {
        INFO(name);
        const std::string problems = studio.problems_of({{"a.l", "#include \"" + name + "\"\n" + stalk}}, "a.l");
        CHECK_THAT(problems, Contains("what is open reads only files below"));
        CHECK_FALSE(studio.has_told_secret());
        CHECK(studio.ask({{"do", "share"}}).dump().find("password") == std::string::npos);
    }
}

TEST_CASE("a link's link out of its folder is followed no further than another path", "[studio]") {
    Pasted studio;
    fs::create_directories(studio.folder.path() / "shared/a");
    studio.paste(link_of({{"b.l", stalk}}, "b.l"));
    studio.wait_until_grown();
    const fs::path home = studio.folder.path() / "shared/b";
    fs::create_symlink(studio.folder.path() / "secret.txt", home / "in.h");
    std::ofstream(home / "c.l") << "#include \"in.h\"\n" << stalk;
    studio.page.texts.clear();
    studio.ask({{"do", "open"}, {"path", (home / "c.l").string()}});
    studio.wait([&] { return studio.page.last("problems").dump().find("reads only") != std::string::npos; });
    CHECK_FALSE(studio.has_told_secret());
}

TEST_CASE("a scene of a link names no model, mesh, picture or table of somebody else's", "[studio]") {
    Pasted studio;
    const std::string plant = "[[plant]]\nmodel = \"a.l\"\n";
    const std::vector<std::string> scenes{
        "[[plant]]\nmodel = \"../../secret.txt\"\n",
        "[[plant]]\nmodel = \"/proc/self/environ\"\n",
        "[[plant]]\nmodel = \"a.l\"\nview = \"../../secret.txt\"\n",
        plant + "[environment.shape]\nprocess = \"shape\"\nshape = \"mesh\"\nfile = \"../../secret.obj\"\n",
        plant + "[environment.grid]\nprocess = \"vdb\"\nfile = \"/etc/passwd\"\n",
        plant + "[[plant.stage]]\nstage = \"leaves\"\ntexture = \"/etc/passwd\"\n"};
    for (const std::string& scene : scenes) {
        INFO(scene);
        const std::string problems = studio.problems_of({{"s.toml", scene}, {"a.l", stalk}}, "s.toml");
        CHECK_THAT(problems, Contains("reads only files below") || Contains("there is no picture"));
        CHECK_FALSE(studio.has_told_secret());
        CHECK(problems.find("root:") == std::string::npos);
    }
}

TEST_CASE("a link starts no program", "[studio]") {
    Pasted studio;
    const fs::path started = studio.folder.path() / "started";
    const std::string command = "command = [\"touch\", \"" + started.string() + "\"]\n";
    const std::string scene = "[[plant]]\nmodel = \"a.l\"\n\n[environment]\n";
    const std::string asks = "lsystem: 1\nderivation length: 1\naxiom: F ?E(1)\nendlsystem\n";
    for (const auto& [environment, file] : std::map<std::string, std::string>{
             {"[environment.x]\nprocess = \"external\"\n" + command, "executable: /bin/true\n"},
             {"[environment.x]\nprocess = \"external\"\nfolder = \"/\"\n" + command, "executable: /bin/true\n"},
             {"file = \"a.e\"\n", "executable: /usr/bin/touch " + started.string() + "\n"}}) {
        INFO(environment);
        CHECK_THAT(studio.problems_of({{"s.toml", scene + environment}, {"a.l", asks}, {"a.e", file}}, "s.toml"),
                   Contains("came by a link") && Contains("no program is started"));
        CHECK_FALSE(fs::exists(started));
    }
}

TEST_CASE("a link's pictures are its own or the library's", "[studio]") {
    Pasted studio;
    const std::string picture = (studio.folder.path() / "own.png").string();
    studio.folder.write("own.png", "a picture of somebody else's");
    studio.folder.write("own.bark", "stripes = 3\n");
    const std::string model = "lsystem: 1\nderivation length: 1\naxiom: @Tx(1)F(1)\nendlsystem\n";
    for (const std::string& texture :
         {picture, (studio.folder.path() / "own.bark").string(), std::string("../../own.png")}) {
        INFO(texture);
        const std::string problems = studio.problems_of({{"s.toml", "[[plant]]\nmodel = \"a.l\"\nview = \"a.v\"\n"},
                                                         {"a.l", model},
                                                         {"a.v", "texture: F: " + texture + "\n"}},
                                                        "s.toml");
        CHECK_THAT(problems, Contains("reads only files below"));
    }
}

TEST_CASE("a model of a link scans no file of the opened folder", "[studio]") {
    Pasted studio;
    studio.folder.write("number.txt", "42\n");
    const char* const reader = R"(lsystem: 1
Start: { h = fopen("number.txt", "r"); x = 0; if (h > 0) { fscanf(h, "%f", &x); fclose(h); } }
derivation length: 1
axiom: A
A --> F(1 + x) A
endlsystem
)";
    const auto height = [&](const Json& link) {
        CHECK_FALSE(studio.paste(link).contains("error"));
        studio.wait_until_grown();
        CHECK(studio.page.last("problems")["problems"].empty());
        return number_at<float>(studio.page.packets.back(), 48);  // the y of the highest corner
    };
    CHECK(height(link_of({{"reader.l", reader}}, "reader.l")) == 1);
    CHECK(height(link_of({{"reader.l", reader}, {"number.txt", "42\n"}}, "reader.l")) == 43);
}

TEST_CASE("a folder that came by a link is limited until its mark is removed", "[studio]") {
    const TemporaryFolder folder, library;
    const Json link = link_of({{"x/a.l", stalk}}, "x/a.l");
    const fs::path main = espalier::studio::write_shared(
        espalier::studio::read_shared(espalier::studio::from_json<espalier::studio::SharedModel>(link), library.path()),
        folder.path());
    CHECK(main == folder.path() / "shared/a/x/a.l");
    const auto permission = espalier::studio::permission_of(main, library.path());
    REQUIRE(permission);
    CHECK(permission->folders == std::vector<fs::path>{folder.path() / "shared/a", library.path() / "models",
                                                       library.path() / "environments"});
    CHECK_FALSE(espalier::studio::permission_of(folder.path() / "other.l", library.path()));
    fs::remove(folder.path() / "shared/a/.came-by-a-link");
    CHECK_FALSE(espalier::studio::permission_of(main, library.path()));
}

TEST_CASE("no document reads devices and pipes, which would never end", "[studio]") {
    OpenStudio studio(stalk);
    const std::string pipe = (studio.folder.path() / "pipe").string();
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    studio.begin();
    studio.wait_until_grown();
    for (const std::string& name : {pipe, std::string("/dev/zero")}) {
        INFO(name);
        studio.page.texts.clear();
        studio.change({{"texts", {{studio.file.string(), "#include \"" + name + "\"\n" + stalk}}}});
        studio.wait([&] {
            return !studio.page.last("problems").is_null() && !studio.page.last("problems")["problems"].empty();
        });
        CHECK_THAT(studio.page.last("problems").dump(), Contains("a device, a pipe or a socket"));
    }
}

TEST_CASE("unsaved work is kept for its owner alone", "[studio]") {
    OpenStudio studio(stalk);
    const TemporaryFolder state;
    studio.options.state = state.path() / "state.json";
    studio.begin();
    studio.wait_until_grown();
    studio.change({{"seed", 3}});
    studio.wait([&] { return fs::exists(studio.options.state); });
    CHECK((fs::status(studio.options.state).permissions() & fs::perms::all) ==
          (fs::perms::owner_read | fs::perms::owner_write));
}

TEST_CASE("a linked file in the opened folder is not opened, though it is offered, and not shared", "[studio]") {
    Pasted studio;
    const TemporaryFolder elsewhere;
    const fs::path secret = elsewhere.write("secret.l", std::string("/* password */\n") + stalk);
    const fs::path link = studio.folder.path() / "harmless.l";
    fs::create_symlink(secret, link);
    studio.options.library = [&] {
        return std::vector<espalier::studio::LibraryEntry>{{link, "harmless", "", "", {}, /*is_own=*/true}};
    };
    CHECK_THAT(studio.ask({{"do", "open"}, {"path", link.string()}}).value("error", ""), Contains("is not below"));
    CHECK_FALSE(studio.has_told_secret());

    // A model may read it, as it may read what else it names; a link to the model does not carry it along.
    studio.folder.write("includes.l", std::string("#include \"harmless.l\"\n"));
    studio.ask({{"do", "open"}, {"path", (studio.folder.path() / "includes.l").string()}});
    studio.wait_until_grown();
    const Json refused = studio.ask({{"do", "share"}});
    CHECK_THAT(refused.value("error", ""), Contains("harmless.l is a link that leads out of"));
    CHECK_FALSE(refused.contains("files"));
}
