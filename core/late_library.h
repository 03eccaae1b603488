#pragma once

namespace daumier {

/// A shared library that is loaded when it is needed first and stays loaded, so that what few commands use does not delay the
/// start of all.
class LateLibrary {
 public:
  /// Loads `file` as the dynamic loader finds it, such as "libarchive.so.13"; `purpose`, such as "reads tar archives", is
  /// for the message. @throws Error if it cannot be loaded, with the cause and the repair.
  LateLibrary(const char* file, const char* purpose);

  /// Becomes the pointer to a function or variable that it is assigned to.
  class Address {
   public:
    explicit Address(void* address) : address_(address) {}
    template <class T>
    operator T*() const {
      return reinterpret_cast<T*>(address_);
    }

   private:
    void* address_;
  };

  /// @throws Error naming a symbol that the library has not.
  Address operator[](const char* symbol) const;

 private:
  const char* file_;
  void* handle_;
};

}  // namespace daumier
