// What the program asks of the operating system beyond the standard library. Only platform.cpp calls POSIX, and
// only platform_windows.cpp Windows.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace espalier::platform {

// --- files ----------------------------------------------------------------------------------------------------------

/// A file open for writing, or one end of a connection. Other programs that are started do not inherit it. Closes
/// itself. A symbolic link is never followed: to open one is the error too_many_symbolic_link_levels.
class OpenFile {
public:
    enum class Mode {
        create,          ///< made, or emptied
        create_private,  ///< the same; only its owner may read a file that is made
        append,          ///< there already; written at its end
        overwrite,       ///< there already; its bytes are replaced in place
        scratch          ///< made; only its owner may read it; read, too
    };

    OpenFile() = default;
    /// Not open if `error` is set.
    OpenFile(const std::filesystem::path& path, Mode mode, std::error_code& error);
    ~OpenFile();
    OpenFile(OpenFile&& other) noexcept;
    OpenFile& operator=(OpenFile&& other) noexcept;

    bool is_open() const { return number_ >= 0; }
    int number() const { return number_; }  ///< the file descriptor; -1: not open

    /// Writes all of it, or stops at the first error.
    [[nodiscard]] std::error_code write(std::string_view bytes);
    [[nodiscard]] std::error_code write(std::span<const std::string_view> parts);
    /// Replaces bytes from `place` on in one call: within a page of 4096 bytes all of them or none, also when the
    /// program is killed.
    [[nodiscard]] std::error_code write_at(std::size_t place, std::string_view bytes);
    /// Fills `bytes` with what lies from `place` on. May be called by several threads.
    [[nodiscard]] std::error_code read_at(std::size_t place, std::span<char> bytes) const;
    [[nodiscard]] std::error_code truncate(std::size_t size);
    /// Some file systems report a full disk only here.
    std::error_code close();

private:
    friend std::error_code connect(OpenFile& ours, OpenFile& theirs);

    int number_ = -1;
};

/// Two connected ends: what is sent into the one is read from the other.
[[nodiscard]] std::error_code connect(OpenFile& ours, OpenFile& theirs);
/// Writes all of it into a connection. If the other end is closed, that is an error and not a signal.
[[nodiscard]] std::error_code send(const OpenFile& connection, std::string_view bytes);
/// Waits at most so long until a connection takes some of `outgoing`, which is then removed from it, or has something
/// to read, which is appended to `incoming`. False once the other end is closed and all it sent is read.
[[nodiscard]] bool converse(const OpenFile& connection, std::string_view& outgoing, std::string& incoming,
                            std::chrono::milliseconds patience);

enum class Access { read, write, execute };
/// Why this process may not use a file or folder so; no error if it may.
std::error_code denied(const std::filesystem::path& path, Access access);

/// Locks a file, which is made if need be and must not be a symbolic link, until `unlock` or the end of this process.
/// Returns what `unlock` takes, or -1 with an error: operation_would_block if another process holds the lock.
int lock(const std::filesystem::path& file, std::error_code& error);
void unlock(int locked);
/// True while a process holds the lock of a file, and where that cannot be known.
bool is_locked(const std::filesystem::path& file);

/// Makes a folder with a new name; the six X at the end of `path` are replaced.
[[nodiscard]] std::error_code make_unique_folder(std::filesystem::path& path);

// --- memory ---------------------------------------------------------------------------------------------------------

/// Advice: fresh memory in large pages, which are touched first in a quarter of the time.
void prefer_huge_pages(void* at, std::size_t bytes);

/// Memory of the machine, in bytes; usable_memory() knows how much of it this process may use.
std::size_t machine_memory();

/// The most memory this process ever held in the machine at once, in bytes.
std::size_t peak_memory();

/// From now on blocks of 1 MiB and more go back to the system when they are freed. By itself the GNU library raises
/// this threshold up to 32 MiB, and columns that plants have outgrown lie unused between those that came later: up to a
/// quarter of what a run held. Up to 16 MiB of small blocks stay: plants that come from disk would fetch the same pages
/// again and again.
void give_back_large_blocks();

// --- this program ---------------------------------------------------------------------------------------------------

int process_number();

/// The file of this program; empty where the system does not say.
std::filesystem::path program_file();

/// Gives unused standard streams a file that ignores what is written: a file must not be opened under the number of a
/// standard stream that is closed, or messages land in it.
void occupy_standard_streams();

/// Is standard error a terminal that redraws a line?
bool has_terminal();

/// Are standard input and standard error terminals, so that a question is seen and answered?
bool can_ask();

/// Waits at most so long until there is something to read from standard input, or its end.
bool input_waits(std::chrono::milliseconds patience);

/// Writes to standard error; allowed in a signal handler.
void write_error(std::string_view text);

/// Waits until no program can write to standard input any more.
void wait_for_end_of_input();

/// Becomes another program: returns only why it cannot.
std::error_code become(std::vector<std::string> words);

// --- signals --------------------------------------------------------------------------------------------------------

/// The signals that ask a program to end: Ctrl-C, kill, a terminal that is closed, and those by which batch systems say
/// that a job's time is nearly up (SIGXCPU, SIGUSR1, SIGUSR2). While it lives, a handler of its own answers them. A
/// signal that may repeat and that whoever started the program had made ignored, as `nohup` does, stays so.
class EndSignals {
public:
    /// `only_once`: the second of a kind ends the program, unless it may repeat.
    EndSignals(void (*handler)(int), bool only_once);
    ~EndSignals();
    EndSignals(const EndSignals&) = delete;
    EndSignals& operator=(const EndSignals&) = delete;

private:
    struct Before;
    std::unique_ptr<Before> before_;
};

/// May a signal come a second time without being meant as a second request? Ctrl-C and kill are.
bool may_repeat(int signal);
/// "SIGUSR1"; of the keyboard's "Ctrl-C". Allowed in a signal handler.
const char* name_of_signal(int signal);

/// A file larger than the system allows is from now on an error of its writer and does not end the program.
void report_large_files();
/// Nor does an output that no program reads any more.
void report_closed_outputs();

// --- other programs -------------------------------------------------------------------------------------------------

struct ChildProgram {
    std::vector<std::string> words;  ///< the program, looked for in PATH if it has no slash, and its arguments
    std::filesystem::path folder{};  ///< where it starts; empty: where this program is
    int input = -1;                  ///< the descriptor that becomes its standard input; -1: this program's
    int output = -1;                 ///< the same for its standard output and error
    bool keeps_error = false;        ///< its standard error stays this program's
};

/// Starts it in a process group of its own, so that Ctrl-C in a terminal reaches this program alone. Returns its
/// process number. Throws std::system_error saying why it cannot be started.
int start(const ChildProgram& program);

/// Waits until it ends. Returns its exit code, or 128 + the signal that ended it. Throws std::system_error.
int wait_for(int child);

/// Looks without waiting whether it has ended (-1: any child). Returns the process number of one that has, with its
/// code as above, or 0. Throws std::system_error, but for -1 when there is no child.
int poll(int child, int& code);

enum class Ending {
    as_ctrl_c,
    as_kill,
    at_once  ///< and the programs of its process group, which it has started
};
/// Asks a child to end.
void end(int child, Ending how);

/// The end to read from of a pipe that no program writes to: it ends with this program, however that ends.
int lifeline();

/// The descriptor of a standard file.
int number_of(std::FILE* file);

// --- shared libraries -----------------------------------------------------------------------------------------------

/// Opens it for as long as this program runs; `shared`: what is opened later may use its names. Null and why if it
/// cannot be opened.
void* open_library(const std::filesystem::path& file, bool shared, std::string& why);

/// The file of the library or program that a function is in; empty where the system does not say.
std::filesystem::path file_of(const void* function);
template <class Result, class... Arguments>
std::filesystem::path file_of(Result (*function)(Arguments...)) {
    return file_of(reinterpret_cast<const void*>(function));
}

/// A function of an open library by its name; null if it has none.
void* function_of(void* library, const char* name);

}  // namespace espalier::platform
