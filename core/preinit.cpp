// OpenMP threads that wait actively make a 2-thread step some 14 times slower as soon as another process uses one of
// the cores, and OpenBLAS's threads take a core for the first 0.1 s of every program, before they sleep. libgomp and
// OpenBLAS read OMP_WAIT_POLICY and OPENBLAS_THREAD_TIMEOUT (2^N cycles) once, in their constructors, before main. The
// functions of DT_PREINIT_ARRAY run before every constructor of every library: there the program starts itself again
// with the variables set, which costs the loading of its libraries but none of their start-up. Whoever sets a variable
// to anything keeps it.
#include <sys/auxv.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

namespace {

constexpr const char* kSettings[] = {"OMP_WAIT_POLICY=PASSIVE", "OPENBLAS_THREAD_TIMEOUT=20"};
constexpr size_t kNumSettings = sizeof(kSettings) / sizeof(kSettings[0]);
constexpr char kGuard[] = "DAUMIER_RESTARTED=1";  // Whatever strips them, the program does not go in circles.

bool StartsWith(const char* text, const char* head) {
  return std::strncmp(text, head, std::strlen(head)) == 0;
}

/// Up to and with the '='.
bool HasName(const char* entry, const char* assignment) {
  return std::strncmp(entry, assignment, static_cast<size_t>(std::strchr(assignment, '=') - assignment) + 1) == 0;
}

/// The C library is relocated but not initialised here: no malloc, no getenv, no C++ objects.
void RestartWithSettings(int, char** argv, char** envp) {
  if (getauxval(AT_BASE) == 0) return;  // Started through ld.so: /proc/self/exe is not this program.
  size_t num_entries = 0;
  bool is_set[kNumSettings] = {};
  for (; envp[num_entries] != nullptr; ++num_entries) {
    const char* const entry = envp[num_entries];
    if (HasName(entry, kGuard)) return;
    for (size_t i = 0; i < kNumSettings; ++i) is_set[i] = is_set[i] || HasName(entry, kSettings[i]);
    // valgrind does not follow a program that starts itself again.
    if (StartsWith(entry, "LD_PRELOAD=") && std::strstr(entry, "vgpreload") != nullptr) return;
  }
  auto** const environment = static_cast<char**>(__builtin_alloca((num_entries + kNumSettings + 2) * sizeof(char*)));
  std::memcpy(environment, envp, num_entries * sizeof(char*));
  char** end = environment + num_entries;
  for (size_t i = 0; i < kNumSettings; ++i)
    if (!is_set[i]) *end++ = const_cast<char*>(kSettings[i]);
  *end++ = const_cast<char*>(kGuard);
  *end = nullptr;

  char path[4096];  // Its own name rather than /proc/self/exe, which would make "exe" the name that ps shows.
  const ssize_t length = readlink("/proc/self/exe", path, sizeof(path) - 1);
  if (length <= 0) return;
  path[length] = '\0';
  execve(path, argv, environment);  // Returns only on failure; the program then continues unchanged.
}

__attribute__((section(".preinit_array"), used)) void (*const preinit)(int, char**, char**) = RestartWithSettings;

}  // namespace
