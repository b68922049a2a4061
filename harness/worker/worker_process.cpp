#include "worker/worker_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <system_error>
#include <thread>
#include <vector>

#include "plumb/assert.hpp"

extern char** environ;

namespace plumb::harness {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t tail_size = 4096;
constexpr int poll_milliseconds = 20;  // how long a backend may eat memory unseen

volatile sig_atomic_t signal_caught = 0;

void remember_signal(int number) { signal_caught = number; }

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

// Above the descriptors that the worker is given, so that duplicating them never runs over another.
int moved_up(int descriptor) {
  const int high = fcntl(descriptor, F_DUPFD_CLOEXEC, 32);
  if (high < 0) fail("duplicating a descriptor");
  close(descriptor);
  return high;
}

struct Pipe {
  int read = -1, write = -1;
};

Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail("making a pipe");
  return {moved_up(ends[0]), moved_up(ends[1])};
}

void close_if_open(int& descriptor) {
  if (descriptor >= 0) close(descriptor);
  descriptor = -1;
}

void make_nonblocking(int descriptor) { fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) | O_NONBLOCK); }

class SpawnSettings {
 public:
  SpawnSettings() {
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
};

std::string signal_text(int number) {
  const char* name = sigabbrev_np(number);
  const char* description = sigdescr_np(number);
  return fmt::format("SIG{} ({})", name == nullptr ? std::to_string(number) : name,
                     description == nullptr ? "unknown signal" : description);
}

// "1.25 GB", "400 MB", "12 kB": three digits.
std::string bytes_text(std::uint64_t bytes) {
  const auto size = static_cast<double>(bytes);
  if (size >= 1e9) return fmt::format("{:.3g} GB", size / 1e9);
  return size >= 1e6 ? fmt::format("{:.3g} MB", size / 1e6) : fmt::format("{:.3g} kB", size / 1e3);
}

}  // namespace

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = remember_signal;
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaction(number, &action, nullptr);
  action.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &action, nullptr);
}

void throw_if_interrupted() {
  if (signal_caught != 0) throw Interrupted{static_cast<int>(signal_caught)};
}

WorkerProcess::WorkerProcess(const std::string& backend_file) {
  Pipe requests = make_pipe(), answers = make_pipe(), output = make_pipe();
  const int shared = moved_up(memfd_create("plumb-progress", MFD_CLOEXEC));
  if (ftruncate(shared, sizeof(Progress)) != 0) fail("sizing shared memory");
  void* memory = mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED, shared, 0);
  if (memory == MAP_FAILED) fail("mapping shared memory");
  progress_ = new (memory) Progress;

  SpawnSettings spawn;
  posix_spawn_file_actions_addopen(&spawn.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&spawn.actions, output.write, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&spawn.actions, output.write, STDERR_FILENO);
  posix_spawn_file_actions_adddup2(&spawn.actions, requests.read, worker_requests);
  posix_spawn_file_actions_adddup2(&spawn.actions, answers.write, worker_answers);
  posix_spawn_file_actions_adddup2(&spawn.actions, shared, worker_progress);
  sigset_t defaults;
  sigemptyset(&defaults);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) sigaddset(&defaults, number);
  posix_spawnattr_setsigdefault(&spawn.attributes, &defaults);
  posix_spawnattr_setpgroup(&spawn.attributes, 0);
  posix_spawnattr_setflags(&spawn.attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);

  std::string program = "plumb", verb = "worker", option = "--backend", file = backend_file;
  std::array<char*, 5> arguments{program.data(), verb.data(), option.data(), file.data(), nullptr};
  const int failure =
      posix_spawn(&pid_, "/proc/self/exe", &spawn.actions, &spawn.attributes, arguments.data(), environ);
  for (const int descriptor : {requests.read, answers.write, output.write, shared}) close(descriptor);
  requests_ = requests.write;
  answers_ = answers.read;
  output_ = output.read;
  for (const int descriptor : {requests_, answers_, output_}) make_nonblocking(descriptor);
  if (failure != 0) throw std::system_error(failure, std::generic_category(), "starting a worker");
}

WorkerProcess::~WorkerProcess() {
  if (alive()) end_process(true);
  for (int* descriptor : {&requests_, &answers_, &output_}) close_if_open(*descriptor);
  munmap(progress_, sizeof(Progress));
}

Answer WorkerProcess::ask(const Json& request, const WorkerLimits& limits,
                          const std::function<void(const Progress&)>& tick) {
  PLUMB_ASSERT(alive());
  progress_->step = 0;
  progress_->total = 0;
  progress_->clock.start();
  pending_.clear();
  tail_.clear();
  if (!send(line_of(request) + "\n")) return bury();
  int rounds = 0;
  while (true) {
    std::array<pollfd, 2> watched{{{answers_, POLLIN, 0}, {output_, POLLIN, 0}}};
    poll(watched.data(), watched.size(), poll_milliseconds);
    read_output();
    if (signal_caught != 0) end_process(false);
    throw_if_interrupted();
    const bool open = read_answer();
    if (const auto end = pending_.find('\n'); end != std::string::npos) {
      Answer answer;
      answer.json = Json::parse(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
      if (answer.json.is_object()) return answer;
      return put_down("error",
                      "the worker's answer is not JSON: " + pending_.substr(0, std::min<std::size_t>(end, 60)));
    }
    if (!open) return bury();
    if (limits.memory_bytes != 0 && resident_bytes() > limits.memory_bytes) {
      return put_down("out_of_memory",
                      fmt::format("resident memory of {} is above the limit of {}{}", bytes_text(resident_bytes()),
                                  bytes_text(limits.memory_bytes), where()));
    }
    if (const auto late = too_late(limits)) return put_down(late->first, late->second);
    if (tick && ++rounds % 10 == 0) tick(*progress_);
  }
}

bool WorkerProcess::send(const std::string& line) {
  std::size_t sent = 0;
  while (sent < line.size()) {
    const ssize_t count = write(requests_, line.data() + sent, line.size() - sent);
    if (count >= 0) {
      sent += static_cast<std::size_t>(count);
    } else if (errno == EAGAIN) {
      pollfd watched{requests_, POLLOUT, 0};
      poll(&watched, 1, poll_milliseconds);
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

void WorkerProcess::read_output() {
  std::array<char, 4096> buffer{};
  ssize_t count = 0;
  while ((count = read(output_, buffer.data(), buffer.size())) > 0) {
    tail_.append(buffer.data(), static_cast<std::size_t>(count));
    if (tail_.size() > tail_size) tail_.erase(0, tail_.size() - tail_size);
  }
}

bool WorkerProcess::read_answer() {
  std::array<char, 65536> buffer{};
  ssize_t count = 0;
  while ((count = read(answers_, buffer.data(), buffer.size())) > 0)
    pending_.append(buffer.data(), static_cast<std::size_t>(count));
  return count < 0 && (errno == EAGAIN || errno == EINTR);
}

std::uint64_t WorkerProcess::resident_bytes() const {
  std::ifstream file("/proc/" + std::to_string(pid_) + "/statm");
  std::uint64_t total = 0, resident = 0;
  file >> total >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

double WorkerProcess::processor_seconds() const {
  clockid_t clock{};
  timespec time{};
  if (!alive() || clock_getcpuclockid(pid_, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::optional<std::pair<std::string, std::string>> WorkerProcess::too_late(const WorkerLimits& limits) const {
  const CellClock::Times times = progress_->clock.times();
  const double engine = 1e-9 * static_cast<double>(times.engine), judge = 1e-9 * static_cast<double>(times.judge);
  if (engine + judge > limits.all_seconds) return {{"out_of_time", "the time for all of it is over" + where()}};
  if (engine > limits.engine_seconds)
    return {{"timeout", fmt::format("no answer within {:g} s{}", limits.engine_seconds, where())}};
  if (judge > limits.judge_seconds)
    return {{"unjudged", fmt::format("the referee has no answer within {:g} s, beside {:.2g} s of the engine{}",
                                     limits.judge_seconds, engine, where())}};
  return std::nullopt;
}

std::string WorkerProcess::where() const {
  const std::uint64_t step = progress_->step, total = progress_->total;
  return step == 0 ? "" : fmt::format(", in step {} of {}", step, total);
}

std::string WorkerProcess::last_words() const {
  const auto end = tail_.find_last_not_of("\r\n\t ");
  if (end == std::string::npos) return "";
  const auto newline = tail_.find_last_of('\n', end);
  std::string line = tail_.substr(newline == std::string::npos ? 0 : newline + 1, std::string::npos);
  line.resize(std::min<std::size_t>(line.find_last_not_of("\r\n\t ") + 1, 200));
  return "; last printed: " + line;
}

// The worker's answer pipe has ended without an answer: it is dead, or as good as.
Answer WorkerProcess::bury() {
  const int status = wait_for_end(std::chrono::seconds(1));
  read_output();
  if (pid_ > 0) return put_down("error", "the worker closed its pipe and went on" + where());
  Answer answer;
  answer.status = "crashed";
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    answer.reason = signal_text(number) + where() + last_words();
    answer.killed_from_outside = number == SIGKILL || number == SIGTERM || number == SIGINT || number == SIGHUP;
  } else {
    answer.reason =
        fmt::format("the process ended by itself with status {}{}{}", WEXITSTATUS(status), where(), last_words());
  }
  return answer;
}

Answer WorkerProcess::put_down(const std::string& status, const std::string& reason) {
  end_process(false);
  read_output();
  Answer answer;
  answer.status = status;
  answer.reason = reason + last_words();
  return answer;
}

void WorkerProcess::end_process(bool politely) {
  close_if_open(requests_);
  if (politely) wait_for_end(std::chrono::milliseconds(500));
  if (pid_ > 0) {
    kill(-pid_, SIGKILL);
    kill(pid_, SIGKILL);  // its group may not be there yet
    wait_for_end(std::chrono::hours(1));
  }
}

// The wait status; pid_ stays when patience ends first.
int WorkerProcess::wait_for_end(std::chrono::milliseconds patience) {
  PLUMB_ASSERT(pid_ > 0);  // kill(-0) is this program's own group
  const auto start = Clock::now();
  int status = 0;
  while (true) {
    siginfo_t ended{};
    if (waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 || ended.si_pid == pid_) {
      kill(-pid_, SIGKILL);  // what it left behind in its group, while its number is still its own
      waitpid(pid_, &status, 0);
      pid_ = -1;
      return status;
    }
    if (Clock::now() - start > patience) return status;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace plumb::harness
