// What platform.cpp does with POSIX, done with Windows. Descriptors are those of its C library.
#ifdef _WIN32
#include "base/platform.h"

#include <climits>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <fcntl.h>
#include <io.h>
#include <map>
#include <mutex>
#include <sys/stat.h>
#include <thread>
#include <utility>

#define WIN32_LEAN_AND_MEAN
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>
// After windows.h, which they need.
#include <psapi.h>

namespace espalier::platform {
namespace {

namespace fs = std::filesystem;

std::error_code last_error() {
    return {static_cast<int>(::GetLastError()), std::system_category()};
}

std::error_code error_of_c() {
    return {errno, std::generic_category()};
}

[[noreturn]] void fail(const std::error_code& error) {
    throw std::system_error(error);
}

HANDLE handle_of(int descriptor) {
    return reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor));
}

bool is_link(const fs::path& path) {
    std::error_code ignored;
    return fs::is_symlink(fs::symlink_status(path, ignored));
}

int flags_of(OpenFile::Mode mode) {
    constexpr int always = _O_WRONLY | _O_BINARY | _O_NOINHERIT;
    if (mode == OpenFile::Mode::scratch) return _O_RDWR | _O_BINARY | _O_NOINHERIT | _O_CREAT | _O_EXCL;
    if (mode == OpenFile::Mode::create || mode == OpenFile::Mode::create_private) return always | _O_CREAT | _O_TRUNC;
    return mode == OpenFile::Mode::append ? always | _O_APPEND : always;
}

/// Where a file is read or written.
OVERLAPPED from(std::size_t place) {
    OVERLAPPED where{};
    where.Offset = static_cast<DWORD>(place);
    where.OffsetHigh = static_cast<DWORD>(static_cast<std::uint64_t>(place) >> 32);
    return where;
}

/// A descriptor that closes the handle with itself, or -1.
int descriptor_of(HANDLE handle) {
    const int descriptor = ::_open_osfhandle(reinterpret_cast<intptr_t>(handle), _O_BINARY | _O_NOINHERIT);
    if (descriptor < 0) ::CloseHandle(handle);
    return descriptor;
}

int open_shared(const fs::path& file, DWORD access, DWORD creation, std::error_code& error) {
    const HANDLE handle = ::CreateFileW(file.c_str(), access, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                                        nullptr, creation, FILE_ATTRIBUTE_NORMAL, nullptr);
    error = handle == INVALID_HANDLE_VALUE ? last_error() : std::error_code();
    return error ? -1 : descriptor_of(handle);
}

/// A lock of one byte that no file reaches: those that are locked can be read. No error, or the system's.
std::error_code try_lock(int descriptor, DWORD kind) {
    OVERLAPPED place{};
    place.OffsetHigh = 0x40000000;
    if (::LockFileEx(handle_of(descriptor), kind | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &place)) return {};
    if (::GetLastError() != ERROR_LOCK_VIOLATION) return last_error();
    return std::make_error_code(std::errc::operation_would_block);
}

// --- children -------------------------------------------------------------------------------------------------------

struct Child {
    HANDLE process = nullptr;
    HANDLE job = nullptr;  ///< the child and what it starts
};

/// Those that nobody has waited for.
class Children {
public:
    void add(int number, Child child) {
        const std::lock_guard guard(mutex_);
        children_[number] = child;
    }
    Child of(int number) {
        const std::lock_guard guard(mutex_);
        const auto found = children_.find(number);
        return found == children_.end() ? Child{} : found->second;
    }
    std::vector<int> numbers() {
        const std::lock_guard guard(mutex_);
        std::vector<int> numbers;
        for (const auto& [number, child] : children_) numbers.push_back(number);
        return numbers;
    }
    void forget(int number) {
        const std::lock_guard guard(mutex_);
        const auto found = children_.find(number);
        if (found == children_.end()) return;
        ::CloseHandle(found->second.process);
        ::CloseHandle(found->second.job);
        children_.erase(found);
    }

private:
    std::mutex mutex_;
    std::map<int, Child> children_;
};

Children& children() {
    static Children all;
    return all;
}

/// The code of a child that ends within so long, which is then forgotten.
bool ended(int number, DWORD milliseconds, int& code) {
    const Child child = children().of(number);
    if (!child.process) fail(std::make_error_code(std::errc::no_child_process));
    if (::WaitForSingleObject(child.process, milliseconds) != WAIT_OBJECT_0) return false;
    DWORD exit = 0;
    ::GetExitCodeProcess(child.process, &exit);
    code = static_cast<int>(exit);
    children().forget(number);
    return true;
}

/// As the C library of the child reads it back: backslashes count only before a quotation mark.
std::wstring quoted_word(const std::string& word) {
    std::wstring out = L"\"";
    std::size_t backslashes = 0;
    for (const wchar_t c : fs::path(word).wstring()) {
        if (c == L'"') out.append(backslashes + 1, L'\\');
        backslashes = c == L'\\' ? backslashes + 1 : 0;
        out += c;
    }
    out.append(backslashes, L'\\');
    return out + L'"';
}

/// A copy of a descriptor's handle that a child inherits; closes itself.
class Inherited {
public:
    explicit Inherited(int descriptor) {
        ::DuplicateHandle(::GetCurrentProcess(), handle_of(descriptor), ::GetCurrentProcess(), &handle_, 0, TRUE,
                          DUPLICATE_SAME_ACCESS);
    }
    ~Inherited() {
        if (handle_) ::CloseHandle(handle_);
    }
    Inherited(const Inherited&) = delete;
    Inherited& operator=(const Inherited&) = delete;

    HANDLE get() const { return handle_; }

private:
    HANDLE handle_ = nullptr;
};

}  // namespace

// --- files ----------------------------------------------------------------------------------------------------------

OpenFile::OpenFile(const fs::path& path, Mode mode, std::error_code& error)
    : number_(is_link(path) ? -1 : ::_wopen(path.c_str(), flags_of(mode), _S_IREAD | _S_IWRITE)) {
    if (is_open()) {
        error.clear();
    } else {
        error = is_link(path) ? std::make_error_code(std::errc::too_many_symbolic_link_levels) : error_of_c();
    }
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
    while (!bytes.empty()) {
        const auto most = static_cast<unsigned>(std::min<std::size_t>(bytes.size(), 1 << 30));
        const int written = ::_write(number_, bytes.data(), most);
        if (written < 0) return error_of_c();
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return {};
}

std::error_code OpenFile::write(std::span<const std::string_view> parts) {
    for (const std::string_view part : parts) {
        if (const std::error_code error = write(part)) return error;
    }
    return {};
}

std::error_code OpenFile::write_at(std::size_t place, std::string_view bytes) {
    OVERLAPPED where = from(place);
    DWORD written = 0;
    if (!::WriteFile(handle_of(number_), bytes.data(), static_cast<DWORD>(bytes.size()), &written, &where)) {
        return last_error();
    }
    return written < bytes.size() ? std::make_error_code(std::errc::no_space_on_device) : std::error_code();
}

std::error_code OpenFile::read_at(std::size_t place, std::span<char> bytes) const {
    while (!bytes.empty()) {
        OVERLAPPED where = from(place);
        const auto most = static_cast<DWORD>(std::min<std::size_t>(bytes.size(), 1 << 30));
        DWORD count = 0;
        if (!::ReadFile(handle_of(number_), bytes.data(), most, &count, &where)) return last_error();
        if (count == 0) return std::make_error_code(std::errc::io_error);  // it ends before
        place += count;
        bytes = bytes.subspan(count);
    }
    return {};
}

std::error_code OpenFile::truncate(std::size_t size) {
    const int error = ::_chsize_s(number_, static_cast<__int64>(size));
    return {error, std::generic_category()};
}

std::error_code OpenFile::close() {
    if (!is_open()) return {};
    return ::_close(std::exchange(number_, -1)) == 0 ? std::error_code() : error_of_c();
}

// A pipe with a name that both ends write to. Ours does not wait: `converse` looks again every millisecond.
std::error_code connect(OpenFile& ours, OpenFile& theirs) {
    static std::atomic<unsigned> count = 0;
    const std::wstring name =
        L"\\\\.\\pipe\\espalier-" + std::to_wstring(::GetCurrentProcessId()) + L"-" + std::to_wstring(++count);
    constexpr DWORD buffer = 1 << 16;
    const HANDLE server =
        ::CreateNamedPipeW(name.c_str(), PIPE_ACCESS_DUPLEX | FILE_FLAG_FIRST_PIPE_INSTANCE,
                           PIPE_TYPE_BYTE | PIPE_NOWAIT | PIPE_REJECT_REMOTE_CLIENTS, 1, buffer, buffer, 0, nullptr);
    if (server == INVALID_HANDLE_VALUE) return last_error();
    ours.number_ = descriptor_of(server);
    std::error_code error;
    theirs.number_ = open_shared(name, GENERIC_READ | GENERIC_WRITE, OPEN_EXISTING, error);
    return error;
}

namespace {

/// How much of it the pipe took now. False if the other end is closed.
bool send_now(const OpenFile& connection, std::string_view bytes, std::size_t& sent) {
    DWORD written = 0;
    const auto most = static_cast<DWORD>(std::min<std::size_t>(bytes.size(), 1 << 15));
    const bool open = ::WriteFile(handle_of(connection.number()), bytes.data(), most, &written, nullptr) != 0;
    sent = written;
    return open;
}

/// Appends what is there to read. False if the other end is closed and nothing is left.
bool receive_now(const OpenFile& connection, std::string& incoming) {
    std::array<char, 1 << 16> bytes;
    DWORD there = 0, received = 0;
    const HANDLE pipe = handle_of(connection.number());
    if (!::PeekNamedPipe(pipe, nullptr, 0, nullptr, &there, nullptr)) return false;
    if (there == 0) return true;
    if (!::ReadFile(pipe, bytes.data(), static_cast<DWORD>(bytes.size()), &received, nullptr)) return false;
    incoming.append(bytes.data(), received);
    return true;
}

}  // namespace

std::error_code send(const OpenFile& connection, std::string_view bytes) {
    while (!bytes.empty()) {
        std::size_t sent = 0;
        if (!send_now(connection, bytes, sent)) return last_error();
        bytes.remove_prefix(sent);
        if (sent == 0) ::Sleep(1);
    }
    return {};
}

bool converse(const OpenFile& connection, std::string_view& outgoing, std::string& incoming,
              std::chrono::milliseconds patience) {
    const auto end = std::chrono::steady_clock::now() + patience;
    const std::size_t before = incoming.size();
    do {
        std::size_t sent = 0;
        if (!outgoing.empty() && !send_now(connection, outgoing, sent)) return false;
        outgoing.remove_prefix(sent);
        if (!receive_now(connection, incoming)) return false;
        if (sent > 0 || incoming.size() > before) return true;
        ::Sleep(1);
    } while (std::chrono::steady_clock::now() < end);
    return true;
}

std::error_code denied(const fs::path& path, Access access) {
    const int kind = access == Access::read ? 4 : access == Access::write ? 2 : 0;
    return ::_waccess(path.c_str(), kind) == 0 ? std::error_code() : error_of_c();
}

int lock(const fs::path& file, std::error_code& error) {
    if (is_link(file)) {
        error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
        return -1;
    }
    const int descriptor = open_shared(file, GENERIC_READ | GENERIC_WRITE, OPEN_ALWAYS, error);
    if (error) return -1;
    error = try_lock(descriptor, LOCKFILE_EXCLUSIVE_LOCK);
    // `is_locked` holds it for a moment, too.
    for (int i = 0; i < 5 && error == std::errc::operation_would_block; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        error = try_lock(descriptor, LOCKFILE_EXCLUSIVE_LOCK);
    }
    if (!error) return descriptor;
    ::_close(descriptor);
    return -1;
}

void unlock(int locked) {
    ::_close(locked);
}

bool is_locked(const fs::path& file) {
    std::error_code error;
    const int descriptor = open_shared(file, GENERIC_READ, OPEN_EXISTING, error);
    if (error) return error != std::errc::no_such_file_or_directory;
    error = try_lock(descriptor, 0);
    ::_close(descriptor);
    return static_cast<bool>(error);
}

std::error_code make_unique_folder(fs::path& path) {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
    for (int tries = 0; tries < 100; ++tries) {
        std::wstring name = path.wstring();
        LARGE_INTEGER time{};
        ::QueryPerformanceCounter(&time);
        auto number = static_cast<std::uint64_t>(time.QuadPart) * 1000003 + ::GetCurrentProcessId();
        for (std::size_t i = name.size() - 6; i < name.size(); ++i, number /= letters.size()) {
            name[i] = static_cast<wchar_t>(letters[number % letters.size()]);
        }
        if (::CreateDirectoryW(name.c_str(), nullptr)) {
            path = name;
            return {};
        }
        if (::GetLastError() != ERROR_ALREADY_EXISTS) return last_error();
    }
    return std::make_error_code(std::errc::file_exists);
}

// --- memory ---------------------------------------------------------------------------------------------------------

void prefer_huge_pages(void*, std::size_t) {}

std::size_t machine_memory() {
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof status;
    ::GlobalMemoryStatusEx(&status);
    return static_cast<std::size_t>(status.ullTotalPhys);
}

std::size_t peak_memory() {
    PROCESS_MEMORY_COUNTERS counters{};
    ::K32GetProcessMemoryInfo(::GetCurrentProcess(), &counters, sizeof counters);
    return counters.PeakWorkingSetSize;
}

void give_back_large_blocks() {}

// --- this program ---------------------------------------------------------------------------------------------------

int process_number() {
    return static_cast<int>(::GetCurrentProcessId());
}

fs::path program_file() {
    std::wstring name(1 << 15, L'\0');
    name.resize(::GetModuleFileNameW(nullptr, name.data(), static_cast<DWORD>(name.size())));
    return name;
}

void occupy_standard_streams() {
    int descriptor = ::_open("NUL", _O_RDWR);
    while (descriptor >= 0 && descriptor <= 2) descriptor = ::_open("NUL", _O_RDWR);
    if (descriptor >= 0) ::_close(descriptor);
}

bool has_terminal() {
    return ::_isatty(2) != 0;
}

bool can_ask() {
    return ::_isatty(0) != 0 && has_terminal();
}

bool input_waits(std::chrono::milliseconds patience) {
    return ::WaitForSingleObject(::GetStdHandle(STD_INPUT_HANDLE), static_cast<DWORD>(patience.count())) ==
           WAIT_OBJECT_0;
}

void write_error(std::string_view text) {
    [[maybe_unused]] const int ignored = ::_write(2, text.data(), static_cast<unsigned>(text.size()));
}

void wait_for_end_of_input() {
    char byte = 0;
    ::_read(0, &byte, 1);
}

// Windows cannot replace a program: this one waits for the other and ends as that does.
std::error_code become(std::vector<std::string> words) {
    try {
        ::_exit(wait_for(start({.words = std::move(words)})));
    } catch (const std::system_error& error) {
        return error.code();
    }
}

// --- signals --------------------------------------------------------------------------------------------------------

namespace {

void (*answering)(int) = nullptr;
bool answers_once = false;

/// Windows forgets a handler before it calls it.
void answer(int signal) {
    if (!answers_once || may_repeat(signal)) std::signal(signal, answer);
    answering(signal);
}

}  // namespace

struct EndSignals::Before {
    static constexpr std::array signals{SIGINT, SIGTERM, SIGBREAK};
    std::array<void (*)(int), signals.size()> handlers{};
};

EndSignals::EndSignals(void (*handler)(int), bool only_once) : before_(std::make_unique<Before>()) {
    answering = handler;
    answers_once = only_once;
    for (std::size_t i = 0; i < Before::signals.size(); ++i)
        before_->handlers[i] = std::signal(Before::signals[i], answer);
}

EndSignals::~EndSignals() {
    for (std::size_t i = 0; i < Before::signals.size(); ++i) std::signal(Before::signals[i], before_->handlers[i]);
}

// A window of the console that is closed.
bool may_repeat(int signal) {
    return signal == SIGBREAK;
}

const char* name_of_signal(int signal) {
    return signal == SIGTERM ? "SIGTERM" : signal == SIGBREAK ? "SIGBREAK" : "Ctrl-C";
}

void report_large_files() {}

void report_closed_outputs() {}

// --- other programs -------------------------------------------------------------------------------------------------

int start(const ChildProgram& program) {
    std::wstring line;
    for (const std::string& word : program.words) line += (line.empty() ? L"" : L" ") + quoted_word(word);
    const Inherited input(program.input >= 0 ? program.input : 0), output(program.output >= 0 ? program.output : 1);
    const Inherited error(program.output >= 0 && !program.keeps_error ? program.output : 2);
    STARTUPINFOW how{};
    how.cb = sizeof how;
    how.dwFlags = STARTF_USESTDHANDLES;
    how.hStdInput = input.get(), how.hStdOutput = output.get(), how.hStdError = error.get();
    PROCESS_INFORMATION made{};
    const std::wstring folder = program.folder.wstring();
    if (!::CreateProcessW(nullptr, line.data(), nullptr, nullptr, TRUE, CREATE_NEW_PROCESS_GROUP | CREATE_SUSPENDED,
                          nullptr, folder.empty() ? nullptr : folder.c_str(), &how, &made)) {
        fail(last_error());
    }
    const HANDLE job = ::CreateJobObjectW(nullptr, nullptr);
    ::AssignProcessToJobObject(job, made.hProcess);
    ::ResumeThread(made.hThread);
    ::CloseHandle(made.hThread);
    const int number = static_cast<int>(made.dwProcessId);
    children().add(number, {made.hProcess, job});
    return number;
}

int wait_for(int child) {
    int code = 0;
    ended(child, INFINITE, code);
    return code;
}

int poll(int child, int& code) {
    const std::vector<int> candidates = child == -1 ? children().numbers() : std::vector{child};
    for (const int number : candidates) {
        if (ended(number, 0, code)) return number;
    }
    return 0;
}

// A process group of its own does not hear Ctrl-C, but it hears Ctrl-Break.
void end(int child, Ending how) {
    if (how == Ending::at_once) {
        ::TerminateJobObject(children().of(child).job, 137);
    } else {
        ::GenerateConsoleCtrlEvent(CTRL_BREAK_EVENT, static_cast<DWORD>(child));
    }
}

int lifeline() {
    static const int end = [] {
        int ends[2];
        if (::_pipe(ends, 1, _O_BINARY | _O_NOINHERIT) != 0) fail(error_of_c());
        return ends[0];
    }();
    return end;
}

int number_of(std::FILE* file) {
    return ::_fileno(file);
}

// --- shared libraries -----------------------------------------------------------------------------------------------

void* open_library(const fs::path& file, bool, std::string& why) {
    const HMODULE library = ::LoadLibraryW(file.c_str());
    if (!library) why = file.string() + ": " + last_error().message();
    return reinterpret_cast<void*>(library);
}

fs::path file_of(const void* function) {
    HMODULE module = nullptr;
    constexpr DWORD flags = GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT;
    if (!::GetModuleHandleExW(flags, static_cast<LPCWSTR>(function), &module)) return {};
    std::wstring name(1 << 15, L'\0');
    name.resize(::GetModuleFileNameW(module, name.data(), static_cast<DWORD>(name.size())));
    return name;
}

void* function_of(void* library, const char* name) {
    return reinterpret_cast<void*>(::GetProcAddress(static_cast<HMODULE>(library), name));
}

}  // namespace espalier::platform
#endif
