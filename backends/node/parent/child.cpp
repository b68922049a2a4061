#include "child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "plumb/physics_world.hpp"

extern char** environ;

namespace plumb::wire {
namespace {

constexpr int kWireInChild = 3;
constexpr std::size_t kErrorsKept = 2000;

std::string last_line_of(const std::string& text) {
  const std::size_t end = text.find_last_not_of(" \n\r\t");
  if (end == std::string::npos) return {};
  const std::size_t begin = text.find_last_of('\n', end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1,
                     end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

/// The line that names the error, where there is one: an interpreter's trace ends in places, or in its own version.
std::string telling_line_of(const std::string& text) {
  const std::size_t at = text.rfind("Error");
  if (at == std::string::npos) return last_line_of(text);
  const std::size_t begin = text.rfind('\n', at), end = text.find('\n', at);
  return text.substr(begin == std::string::npos ? 0 : begin + 1,
                     (end == std::string::npos ? text.size() : end) - (begin == std::string::npos ? 0 : begin + 1));
}

struct SpawnActions {
  SpawnActions() { posix_spawn_file_actions_init(&actions); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions); }
  posix_spawn_file_actions_t actions;
};

pid_t spawn(const std::vector<std::string>& command, int wire, int errors) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  SpawnActions to_do;
  posix_spawn_file_actions_addopen(&to_do.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&to_do.actions, errors, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&to_do.actions, errors, STDERR_FILENO);
  posix_spawn_file_actions_adddup2(&to_do.actions, wire, kWireInChild);
  pid_t pid = -1;
  const int error = posix_spawnp(&pid, arguments[0], &to_do.actions, nullptr, arguments.data(), environ);
  if (error != 0)
    throw Error(PLUMB_E_UNSUPPORTED, command[0] + " cannot be started (" + std::strerror(error) +
                                         "): install it, or put its folder on PATH");
  return pid;
}

/// Above what spawn hands to the child, so that no descriptor is overwritten before it is handed on.
Descriptor lifted(int number) {
  const int high = fcntl(number, F_DUPFD_CLOEXEC, kWireInChild + 1);
  close(number);
  return Descriptor(high);
}

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}
Descriptor::~Descriptor() {
  if (number_ >= 0) close(number_);
}

Child::Child(const std::vector<std::string>& command) : program_(command.back()) {
  int ends[2], pipes[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw Error(PLUMB_E_OUT_OF_MEMORY, std::string("no socket for a child process: ") + std::strerror(errno));
  wire_ = lifted(ends[0]);
  const Descriptor theirs = lifted(ends[1]);
  if (pipe2(pipes, O_CLOEXEC) != 0)
    throw Error(PLUMB_E_OUT_OF_MEMORY, std::string("no pipe for a child process: ") + std::strerror(errno));
  errors_ = lifted(pipes[0]);
  const Descriptor their_errors = lifted(pipes[1]);
  fcntl(wire_.get(), F_SETFL, O_NONBLOCK);
  fcntl(errors_.get(), F_SETFL, O_NONBLOCK);
  pid_ = spawn(command, theirs.get(), their_errors.get());
}

Child::~Child() {
  if (pid_ <= 0) return;
  kill(pid_, SIGKILL);
  while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) continue;
}

Frame Child::call(Call call, const std::string& text, std::span<const double> numbers,
                  std::chrono::duration<double> deadline) {
  if (!lost_.empty()) throw Error(PLUMB_E_WORLD_LOST, lost_);
  const std::vector<std::byte> request = encode(call, ++sequence_, text, numbers);
  asked_ = call;
  deadline_seconds_ = deadline.count();
  until_ = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(deadline);
  send(request);
  FrameHeader header{};
  receive(std::as_writable_bytes(std::span(&header, 1)));
  if (header.magic != kMagic || header.text_bytes > kMostText || header.number_count > kMostNumbers)
    lose("answered something that is no frame of plumb.wire/1");
  if (header.call != static_cast<std::uint32_t>(call) || header.sequence != sequence_)
    lose("answered another call than it was asked");
  std::vector<std::byte> body(body_bytes(header));
  receive(body);
  Frame reply = decode(header, body);
  if (header.result == PLUMB_E_WORLD_LOST) lose("gave up: " + reply.text);
  if (header.result < 0) throw Error(header.result, reply.text);
  return reply;
}

void Child::send(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(wire_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent > 0)
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
    else if (errno == EAGAIN)
      wait_for(POLLOUT);
    else if (errno != EINTR)
      lose(how_it_ended());
  }
}

void Child::receive(std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t got = recv(wire_.get(), bytes.data(), bytes.size(), 0);
    if (got > 0)
      bytes = bytes.subspan(static_cast<std::size_t>(got));
    else if (got == 0 || (errno != EAGAIN && errno != EINTR))
      lose(how_it_ended());
    else if (errno == EAGAIN)
      wait_for(POLLIN);
  }
}

// Also reads what the child writes to its standard streams, lest it stands still before a full pipe.
void Child::wait_for(short events) {
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until_ - std::chrono::steady_clock::now());
  if (left.count() <= 0)
    lose("did not answer within " + std::to_string(deadline_seconds_).substr(0, 5) +
         " s and was killed; the setting call_deadline gives it more");
  pollfd watched[2] = {{wire_.get(), events, 0}, {errors_.get(), POLLIN, 0}};
  poll(watched, 2, static_cast<int>(std::min<long long>(left.count() + 1, 1000)));
  if (watched[1].revents != 0) keep_errors();
}

void Child::keep_errors() {
  char piece[4096];
  ssize_t got = 0;
  while (errors_.get() >= 0 && (got = read(errors_.get(), piece, sizeof piece)) > 0) {
    last_errors_.append(piece, static_cast<std::size_t>(got));
    if (last_errors_.size() > kErrorsKept) last_errors_.erase(0, last_errors_.size() - kErrorsKept);
  }
  if (got == 0) errors_ = Descriptor();  // it closed them: poll would never wait again
}

std::string Child::how_it_ended() {
  // Its last words may be on their way while it goes.
  int status = 0;
  pid_t ended = 0;
  while ((ended = waitpid(pid_, &status, WNOHANG)) == 0 && std::chrono::steady_clock::now() < until_) usleep(1000);
  if (ended != pid_) return "closed its end of the wire";
  pid_ = -1;
  if (WIFSIGNALED(status)) return std::string("was ended by a signal: ") + strsignal(WTERMSIG(status));
  return "ended with status " + std::to_string(WEXITSTATUS(status));
}

void Child::lose(const std::string& what) {
  keep_errors();
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) continue;
    pid_ = -1;
  }
  lost_ = "the child process of " + program_ + " " + what + " (asked for " + call_name(asked_) + ")";
  if (const std::string line = telling_line_of(last_errors_); !line.empty()) lost_ += "; it wrote: " + line;
  throw Error(PLUMB_E_WORLD_LOST, lost_);
}

}  // namespace plumb::wire
