#include "isolated_process.hpp"

#include <signal.h>
#include <stdio_ext.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <limits>
#include <thread>

namespace octafield::volume {
namespace {

// A file in memory, shared with the child.
class MemoryFile {
public:
    explicit MemoryFile(const char* name) : descriptor_(memfd_create(name, MFD_CLOEXEC)) {
        if (descriptor_ < 0)
            throw SolverError("no temporary memory for the mesher: " + std::string(std::strerror(errno)));
    }
    ~MemoryFile() { close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    int descriptor() const { return descriptor_; }

    template <class Container>
    Container read_all() const {
        const off_t size = lseek(descriptor_, 0, SEEK_END);
        Container content(static_cast<std::size_t>(std::max<off_t>(size, 0)), typename Container::value_type{});
        std::size_t done = 0;
        while (done < content.size()) {
            const ssize_t count =
                pread(descriptor_, content.data() + done, content.size() - done, static_cast<off_t>(done));
            if (count <= 0)
                throw SolverError("the mesher's result could not be read: " + std::string(std::strerror(errno)));
            done += static_cast<std::size_t>(count);
        }
        return content;
    }

private:
    int descriptor_;
};

bool write_all(int descriptor, const void* bytes, std::size_t count) {
    const char* next = static_cast<const char*>(bytes);
    while (count > 0) {
        const ssize_t written = write(descriptor, next, count);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        next += written;
        count -= static_cast<std::size_t>(written);
    }
    return true;
}

// The parent's signal handlers (Python's, a sanitizer's) must not run in the child, a crash must leave no core file,
// and the parent's death must end the child. What stdio still buffers belongs to the parent.
void become_isolated(pid_t parent, int printed) {
    for (const int signal_number : {SIGINT, SIGTERM, SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL})
        signal(signal_number, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);  // it died before the line above
    __fpurge(stdout);
    __fpurge(stderr);
    dup2(printed, STDOUT_FILENO);
    dup2(printed, STDERR_FILENO);
    setvbuf(stdout, nullptr, _IONBF, 0);
}

constexpr int done_code = 0, failed_code = 1;

[[noreturn]] void run_child(pid_t parent, const std::function<void(const Emit&)>& work, int result, int printed) {
    become_isolated(parent, printed);
    bool complete = true;
    try {
        work([&](const void* bytes, std::size_t count) { complete = complete && write_all(result, bytes, count); });
    } catch (...) {
        complete = false;
    }
    _exit(complete ? done_code : failed_code);
}

void kill_and_reap(pid_t child) {
    kill(child, SIGKILL);
    while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
    }
}

// The child's wait status. Short work is noticed at once, long work is polled every 20 ms.
int wait_for(pid_t child, const std::string& phase, const Progress& progress) {
    auto pause = std::chrono::microseconds(200);
    for (;;) {
        int status = 0;
        const pid_t ended = waitpid(child, &status, WNOHANG);
        if (ended == child) return status;
        if (ended < 0 && errno != EINTR)
            throw SolverError("the mesher's process was lost: " + std::string(std::strerror(errno)));
        try {
            report_or_throw(progress, phase, -1, std::numeric_limits<double>::quiet_NaN());
        } catch (...) {
            kill_and_reap(child);
            throw;
        }
        std::this_thread::sleep_for(pause);
        pause = std::min(2 * pause, std::chrono::microseconds(20000));
    }
}

}  // namespace

void end_after(int seconds) {
    signal(SIGXCPU, SIG_DFL);
    const rlimit limit{static_cast<rlim_t>(seconds), RLIM_INFINITY};
    setrlimit(RLIMIT_CPU, &limit);
}

IsolatedOutcome run_isolated(const std::function<void(const Emit&)>& work, const std::string& phase,
                             const Progress& progress) {
    const MemoryFile result("octafield-result"), printed("octafield-printed");
    // No handler of the parent's may run in the child before become_isolated has put the defaults back.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const pid_t parent = getpid(), child = fork();
    if (child != 0) pthread_sigmask(SIG_SETMASK, &before, nullptr);
    if (child < 0)
        throw SolverError("no process could be started for the mesher: " + std::string(std::strerror(errno)));
    if (child == 0) run_child(parent, work, result.descriptor(), printed.descriptor());
    const int status = wait_for(child, phase, progress);
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGINT) throw Cancelled("cancelled during " + phase);
    IsolatedOutcome outcome;
    outcome.finished = WIFEXITED(status) && WEXITSTATUS(status) == done_code;
    outcome.out_of_time = WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU;
    if (outcome.finished) outcome.result = result.read_all<std::vector<std::byte>>();
    outcome.printed = printed.read_all<std::string>();
    return outcome;
}

}  // namespace octafield::volume
