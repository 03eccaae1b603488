#include "core/late_library.h"

#include "core/error.h"

#include <dlfcn.h>

namespace daumier {

LateLibrary::LateLibrary(const char* file, const char* purpose)
    : file_(file), handle_(dlopen(file, RTLD_NOW | RTLD_LOCAL)) {
  DAUMIER_CHECK(handle_ != nullptr, "{} cannot be loaded, which {} ({}). Install it: ./dev setup", file, purpose,
                dlerror());
}

LateLibrary::Address LateLibrary::operator[](const char* symbol) const {
  void* const address = dlsym(handle_, symbol);
  DAUMIER_CHECK(address != nullptr, "{} has no {}. Install the version that Daumier was built with", file_, symbol);
  return Address(address);
}

}  // namespace daumier
