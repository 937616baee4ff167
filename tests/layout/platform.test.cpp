// One source calls the operating system; all others go through base/platform.h.
#include "catch.h"
#include "sources.h"

#include <regex>

namespace {

using namespace layout;

const fs::path platform = "src/base/platform.cpp";

/// The halves for POSIX and for Windows.
bool is_platform(const fs::path& file) {
    return file == platform || file == "src/base/platform_windows.cpp";
}

/// Headers of POSIX and of the system's C library, also by their C++ name.
bool is_of_the_system(const std::string& include) {
    static const std::regex header(
        R"((sys|net|netinet|arpa|linux|mach|asm)/.*|)"
        R"((unistd|fcntl|signal|dlfcn|poll|spawn|pthread|dirent|termios|malloc|sched|io|windows|psapi|semaphore|mqueue|aio|ftw|fnmatch|)"
        R"(glob|grp|pwd|netdb|link|ifaddrs|langinfo|libgen|strings|syslog|ucontext|utime|wordexp|execinfo|alloca)\.h|)"
        R"(csignal)");
    return std::regex_match(include, header);
}

/// The function of the system that a line calls, or "". The headers of the standard library declare some of them.
std::string system_call_in(const std::string& line) {
    static const std::regex qualified(R"((?:^|[^\w:>])::([a-z_]\w*)\()");
    static const std::regex plain(
        R"((?:^|[^\w:.>])(mkdtemp|mkstemp|mkostemp|fileno|fdopen|popen|pclose|getpid|isatty|setenv|unsetenv|putenv|)"
        R"(realpath|readlink|getrusage|sysconf|mmap|munmap|madvise|fsync|fork|execvp?|waitpid|sigaction|dlopen|dlsym|)"
        R"(mallopt|malloc_trim|posix_memalign|usleep|nanosleep|localtime_r|gmtime_r|strerror_r|gethostname|flockfile|)"
        R"(getline_unlocked|open_memstream|fmemopen)\()");
    std::smatch match;
    const std::string code = line.substr(0, line.find("//"));
    if (std::regex_search(code, match, qualified) || std::regex_search(code, match, plain)) return match[1];
    return "";
}

}  // namespace

TEST_CASE("only one source includes headers of the system and calls its functions", "[layout]") {
    std::size_t files = 0, system_headers = 0;
    for (const char* folder : {"src", "include"}) {
        for (const fs::path& file : sources_below(folder)) {
            ++files;
            for (const std::string& include : includes_of(file)) {
                INFO(file << " includes " << include);
                if (!is_of_the_system(include)) continue;
                CHECK(is_platform(file));
                ++system_headers;
            }
            if (is_platform(file)) continue;
            for (const std::string& line : lines_of(file)) {
                INFO(file << ": " << line);
                CHECK(system_call_in(line).empty());
            }
        }
    }
    CHECK(files > 600);
    CHECK(system_headers > 8);
}

TEST_CASE("the test of system calls knows headers and functions of the system", "[layout]") {
    CHECK(is_of_the_system("unistd.h"));
    CHECK(is_of_the_system("sys/mman.h"));
    CHECK(is_of_the_system("csignal"));
    CHECK_FALSE(is_of_the_system("cstdlib"));
    CHECK_FALSE(is_of_the_system("boost/asio/signal_set.hpp"));
    CHECK_FALSE(is_of_the_system("base/platform.h"));
    CHECK(system_call_in("    const int descriptor = ::open(path.c_str(), O_RDONLY);") == "open");
    CHECK(system_call_in("    if (!mkdtemp(name.data())) return;") == "mkdtemp");
    CHECK(system_call_in("    return std::filesystem::absolute(path);").empty());
    CHECK(system_call_in("    platform::start(program);").empty());
    CHECK(system_call_in("    // as ::open() does").empty());
    CHECK(system_call_in("    new (place) T; ::new (at) U(x);").empty());
}
