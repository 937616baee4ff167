// A document as a link carries it.
#pragma once

#include "studio/protocol/declaration.h"

#include <cstdint>

namespace espalier::studio {

constexpr int most_steps = 100000000;  ///< most steps of a growth: more than can be looked at

struct SharedFile {
    static constexpr TypeName type{"SharedFile",
                                   "a file of a link, told by its content or named if the library has it"};
    std::string path;
    std::optional<std::string> content, library, digest;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("path", self.path, "below one folder");
        field("content", self.content, "its text, or its bytes in base64 if it is a colour map or materials");
        field("library", self.library, "its name in the library");
        field("digest", self.digest, "of the library's file, in hexadecimal");
    }
};

struct SharedModel {
    static constexpr TypeName type{"SharedModel", "what a link holds"};
    std::string main;
    std::vector<SharedFile> files;
    std::optional<std::uint64_t> seed;
    std::optional<int> steps;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("main", self.main, "path of the file to open");
        field("files", self.files, "the document and what it reads");
        field("seed", self.seed, "instead of what the files say");
        field("steps", self.steps, "instead of what the files say", between(0, most_steps));
    }
};

}  // namespace espalier::studio
