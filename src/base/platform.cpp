// POSIX; platform_windows.cpp is for Windows.
#ifndef _WIN32
#include "base/platform.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <dlfcn.h>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
#include <spawn.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#ifdef __APPLE__
#include <mach-o/dyld.h>
#endif

extern char** environ;

namespace espalier::platform {
namespace {

namespace fs = std::filesystem;

std::error_code last_error() {
    return {errno, std::generic_category()};
}

std::error_code error_unless(bool done) {
    return done ? std::error_code() : last_error();
}

int flags_of(OpenFile::Mode mode) {
    constexpr int always = O_WRONLY | O_CLOEXEC | O_NOFOLLOW;
    if (mode == OpenFile::Mode::scratch) return O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW;
    if (mode == OpenFile::Mode::create || mode == OpenFile::Mode::create_private) return always | O_CREAT | O_TRUNC;
    return mode == OpenFile::Mode::append ? always | O_APPEND : always;
}

bool is_private(OpenFile::Mode mode) {
    return mode == OpenFile::Mode::create_private || mode == OpenFile::Mode::scratch;
}

/// No error, or the system's.
std::error_code try_lock(int descriptor, int kind) {
    return error_unless(::flock(descriptor, kind | LOCK_NB) == 0);
}

/// The arguments of a program as the system takes them; they lie in `words`.
std::vector<char*> arguments_of(std::vector<std::string>& words) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    return arguments;
}

/// A process group of its own.
class SpawnAttributes {
public:
    SpawnAttributes() {
        posix_spawnattr_init(&attributes_);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
        posix_spawnattr_setpgroup(&attributes_, 0);
    }
    ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }
    SpawnAttributes(const SpawnAttributes&) = delete;
    SpawnAttributes& operator=(const SpawnAttributes&) = delete;

    const posix_spawnattr_t* get() const { return &attributes_; }

private:
    posix_spawnattr_t attributes_;
};

/// What posix_spawn does before the program begins.
class SpawnActions {
public:
    explicit SpawnActions(const ChildProgram& program) {
        posix_spawn_file_actions_init(&actions_);
        if (program.input >= 0) posix_spawn_file_actions_adddup2(&actions_, program.input, STDIN_FILENO);
        if (program.output >= 0) {
            posix_spawn_file_actions_adddup2(&actions_, program.output, STDOUT_FILENO);
            if (!program.keeps_error) posix_spawn_file_actions_adddup2(&actions_, program.output, STDERR_FILENO);
        }
        if (!program.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions_, program.folder.c_str());
    }
    ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
    SpawnActions(const SpawnActions&) = delete;
    SpawnActions& operator=(const SpawnActions&) = delete;

    const posix_spawn_file_actions_t* get() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_;
};

int code_of(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// Linux says with every call what macOS says once of a socket.
#ifdef __APPLE__
constexpr int without_signal = 0;

bool connected_pair(int (&ends)[2]) {
    if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) return false;
    for (const int end : ends) {
        const int on = 1;
        ::fcntl(end, F_SETFD, FD_CLOEXEC);
        ::setsockopt(end, SOL_SOCKET, SO_NOSIGPIPE, &on, sizeof on);
    }
    return true;
}
#else
constexpr int without_signal = MSG_NOSIGNAL;

bool connected_pair(int (&ends)[2]) {
    return ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0;
}
#endif

[[noreturn]] void fail(int error) {
    throw std::system_error(error, std::generic_category());
}

}  // namespace

// --- files ----------------------------------------------------------------------------------------------------------

OpenFile::OpenFile(const fs::path& path, Mode mode, std::error_code& error)
    : number_(::open(path.c_str(), flags_of(mode), is_private(mode) ? 0600 : 0666)) {
    error = error_unless(is_open());
}

OpenFile::~OpenFile() {
    close();
}

OpenFile::OpenFile(OpenFile&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

OpenFile& OpenFile::operator=(OpenFile&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
}

std::error_code OpenFile::write(std::string_view bytes) {
    return write(std::span(&bytes, 1));
}

// In few calls: a kernel that is given much at once takes larger pages for it.
std::error_code OpenFile::write(std::span<const std::string_view> parts) {
    constexpr std::size_t most = 512;  // below IOV_MAX, 1024 where there are such systems
    std::vector<iovec> pieces;
    for (const std::string_view part : parts) {
        if (!part.empty()) pieces.push_back({const_cast<char*>(part.data()), part.size()});
    }
    for (std::size_t first = 0; first < pieces.size();) {
        const std::size_t count = std::min(most, pieces.size() - first);
        const ssize_t result = ::writev(number_, &pieces[first], static_cast<int>(count));
        if (result < 0 && errno == EINTR) continue;
        if (result < 0) return last_error();
        auto written = static_cast<std::size_t>(result);
        for (; first < pieces.size() && written >= pieces[first].iov_len; ++first) written -= pieces[first].iov_len;
        if (written == 0) continue;
        pieces[first].iov_base = static_cast<char*>(pieces[first].iov_base) + written;
        pieces[first].iov_len -= written;
    }
    return {};
}

std::error_code OpenFile::write_at(std::size_t place, std::string_view bytes) {
    const ssize_t written = ::pwrite(number_, bytes.data(), bytes.size(), static_cast<off_t>(place));
    if (written < 0) return last_error();
    if (static_cast<std::size_t>(written) < bytes.size()) return std::make_error_code(std::errc::no_space_on_device);
    return {};
}

std::error_code OpenFile::read_at(std::size_t place, std::span<char> bytes) const {
    while (!bytes.empty()) {
        const ssize_t count = ::pread(number_, bytes.data(), bytes.size(), static_cast<off_t>(place));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return last_error();
        if (count == 0) return std::make_error_code(std::errc::io_error);  // it ends before
        place += static_cast<std::size_t>(count);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return {};
}

std::error_code OpenFile::truncate(std::size_t size) {
    return error_unless(::ftruncate(number_, static_cast<off_t>(size)) == 0);
}

std::error_code OpenFile::close() {
    return is_open() ? error_unless(::close(std::exchange(number_, -1)) == 0) : std::error_code();
}

std::error_code connect(OpenFile& ours, OpenFile& theirs) {
    int ends[2];
    if (!connected_pair(ends)) return last_error();
    theirs.number_ = ends[0];
    ours.number_ = ends[1];
    return {};
}

std::error_code send(const OpenFile& connection, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(connection.number(), bytes.data(), bytes.size(), without_signal);
        if (sent < 0 && errno == EINTR) continue;
        if (sent < 0) return last_error();
        bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return {};
}

bool converse(const OpenFile& connection, std::string_view& outgoing, std::string& incoming,
              std::chrono::milliseconds patience) {
    const auto wanted = static_cast<short>(outgoing.empty() ? POLLIN : POLLIN | POLLOUT);
    pollfd ready{connection.number(), wanted, 0};
    if (::poll(&ready, 1, static_cast<int>(patience.count())) <= 0) return true;
    if (ready.revents & POLLOUT) {
        const ssize_t sent =
            ::send(connection.number(), outgoing.data(), outgoing.size(), without_signal | MSG_DONTWAIT);
        if (sent > 0) outgoing.remove_prefix(static_cast<std::size_t>(sent));
    }
    if (!(ready.revents & (POLLIN | POLLHUP | POLLERR))) return true;
    std::array<char, 1 << 16> bytes;
    const ssize_t received = ::recv(connection.number(), bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (received > 0) incoming.append(bytes.data(), static_cast<std::size_t>(received));
    return received > 0 || (received < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR));
}

std::error_code denied(const fs::path& path, Access access) {
    const int kind = access == Access::read ? R_OK : access == Access::write ? W_OK : X_OK;
    return error_unless(::access(path.c_str(), kind) == 0);
}

int lock(const fs::path& file, std::error_code& error) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    error = error_unless(descriptor >= 0);
    if (error) return -1;
    error = try_lock(descriptor, LOCK_EX);
    // `is_locked` holds it for a moment, too.
    for (int i = 0; i < 5 && error == std::errc::operation_would_block; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        error = try_lock(descriptor, LOCK_EX);
    }
    if (!error) return descriptor;
    ::close(descriptor);
    return -1;
}

void unlock(int locked) {
    ::close(locked);
}

bool is_locked(const fs::path& file) {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
    if (descriptor < 0) return errno != ENOENT;
    const std::error_code error = try_lock(descriptor, LOCK_SH);
    ::close(descriptor);
    return static_cast<bool>(error);
}

std::error_code make_unique_folder(fs::path& path) {
    std::string name = path.string();
    if (!::mkdtemp(name.data())) return last_error();
    path = name;
    return {};
}

// --- memory ---------------------------------------------------------------------------------------------------------

void prefer_huge_pages([[maybe_unused]] void* at, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
    ::madvise(at, bytes, MADV_HUGEPAGE);
#endif
}

std::size_t machine_memory() {
    return static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(::sysconf(_SC_PAGE_SIZE));
}

std::size_t peak_memory() {
    // Linux's rusage also counts what the program that started this one held.
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("VmHWM:")) return std::stoull(line.substr(line.find(':') + 1)) * 1024;
    }
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
    constexpr std::size_t unit = 1;
#else
    constexpr std::size_t unit = 1024;
#endif
    return static_cast<std::size_t>(usage.ru_maxrss) * unit;
}

void give_back_large_blocks() {
#ifdef __GLIBC__
    constexpr int large = 1 << 20, kept = 16 << 20;
    ::mallopt(M_MMAP_THRESHOLD, large);
    ::mallopt(M_TRIM_THRESHOLD, kept);  // the first alone would hold it at 128 KiB
#endif
}

// --- this program ---------------------------------------------------------------------------------------------------

int process_number() {
    return ::getpid();
}

fs::path program_file() {
    std::error_code ignored;
#ifdef __APPLE__
    std::array<char, 4096> name{};
    std::uint32_t size = name.size();
    return ::_NSGetExecutablePath(name.data(), &size) == 0 ? fs::canonical(name.data(), ignored) : fs::path();
#else
    return fs::read_symlink("/proc/self/exe", ignored);
#endif
}

void occupy_standard_streams() {
    int descriptor = ::open("/dev/null", O_RDWR);
    while (descriptor >= 0 && descriptor <= STDERR_FILENO) descriptor = ::open("/dev/null", O_RDWR);
    if (descriptor >= 0) ::close(descriptor);
}

bool has_terminal() {
    return ::isatty(STDERR_FILENO) == 1;
}

bool can_ask() {
    return ::isatty(STDIN_FILENO) == 1 && has_terminal();
}

bool input_waits(std::chrono::milliseconds patience) {
    pollfd ready{STDIN_FILENO, POLLIN, 0};
    return ::poll(&ready, 1, static_cast<int>(patience.count())) > 0;
}

void write_error(std::string_view text) {
    [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, text.data(), text.size());
}

void wait_for_end_of_input() {
    char byte = 0;
    while (::read(STDIN_FILENO, &byte, 1) < 0 && errno == EINTR) {
    }
}

std::error_code become(std::vector<std::string> words) {
    const std::vector<char*> arguments = arguments_of(words);
    ::execv(arguments.front(), arguments.data());
    return last_error();
}

// --- signals --------------------------------------------------------------------------------------------------------

struct EndSignals::Before {
    static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1, SIGUSR2};
    std::array<struct sigaction, signals.size()> actions{};
};

EndSignals::EndSignals(void (*handler)(int), bool only_once) : before_(std::make_unique<Before>()) {
    struct sigaction action = {};
    action.sa_handler = handler;
    for (std::size_t i = 0; i < Before::signals.size(); ++i) {
        const int signal = Before::signals[i];
        struct sigaction& before = before_->actions[i];
        action.sa_flags = only_once && !may_repeat(signal) ? SA_RESETHAND | SA_RESTART : SA_RESTART;
        ::sigaction(signal, &action, &before);
        if (may_repeat(signal) && before.sa_handler == SIG_IGN) ::sigaction(signal, &before, nullptr);
    }
}

EndSignals::~EndSignals() {
    for (std::size_t i = 0; i < Before::signals.size(); ++i) {
        ::sigaction(Before::signals[i], &before_->actions[i], nullptr);
    }
}

// The shell of a closed terminal asks, too; SIGXCPU comes every second; batch systems ask a process and its group.
bool may_repeat(int signal) {
    return signal != SIGINT && signal != SIGTERM;
}

const char* name_of_signal(int signal) {
    switch (signal) {
        case SIGTERM:
            return "SIGTERM";
        case SIGHUP:
            return "SIGHUP";
        case SIGXCPU:
            return "SIGXCPU";
        case SIGUSR1:
            return "SIGUSR1";
        case SIGUSR2:
            return "SIGUSR2";
        default:
            return "Ctrl-C";
    }
}

void report_large_files() {
    std::signal(SIGXFSZ, SIG_IGN);
}

void report_closed_outputs() {
    std::signal(SIGPIPE, SIG_IGN);
}

// --- other programs -------------------------------------------------------------------------------------------------

int start(const ChildProgram& program) {
    std::vector<std::string> words = program.words;
    const std::vector<char*> arguments = arguments_of(words);
    const SpawnAttributes attributes;
    const SpawnActions actions(program);
    pid_t child = 0;
    const int error = posix_spawnp(&child, arguments[0], actions.get(), attributes.get(), arguments.data(), environ);
    if (error != 0) fail(error);
    return child;
}

int wait_for(int child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) fail(errno);
    }
    return code_of(status);
}

int poll(int child, int& code) {
    int status = 0;
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended < 0 && errno != EINTR && !(child == -1 && errno == ECHILD)) fail(errno);
    if (ended <= 0) return 0;
    code = code_of(status);
    return ended;
}

void end(int child, Ending how) {
    if (how == Ending::at_once) {
        ::kill(-child, SIGKILL);
    } else {
        ::kill(child, how == Ending::as_ctrl_c ? SIGINT : SIGTERM);
    }
}

int lifeline() {
    static const int end = [] {
        int ends[2];
        if (::pipe(ends) != 0) fail(errno);
        for (const int descriptor : ends) ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);
        return ends[0];
    }();
    return end;
}

int number_of(std::FILE* file) {
    return ::fileno(file);
}

// --- shared libraries -----------------------------------------------------------------------------------------------

void* open_library(const fs::path& file, bool shared, std::string& why) {
    void* const library = ::dlopen(file.c_str(), RTLD_LAZY | (shared ? RTLD_GLOBAL : RTLD_LOCAL));
    if (!library) why = ::dlerror();
    return library;
}

fs::path file_of(const void* function) {
    ::Dl_info found{};
    if (::dladdr(function, &found) == 0 || !found.dli_fname) return {};
    std::error_code ignored;
    return fs::absolute(found.dli_fname, ignored);
}

void* function_of(void* library, const char* name) {
    return ::dlsym(library, name);
}

}  // namespace espalier::platform
#endif
