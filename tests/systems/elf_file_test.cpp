#include "systems/elf_file.h"

#include "core/error.h"
#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <elf.h>
#include <gtest/gtest.h>

#include <cstring>

namespace daumier::systems {
namespace {

using testing::ExpectError;

/// A file of 400 bytes: header, a segment to load of bytes 120 to 300, two section headers at its end.
std::string SmallElf() {
  std::string bytes(400, '\0');
  Elf64_Ehdr header = {};
  std::memcpy(header.e_ident, ELFMAG, SELFMAG);
  header.e_ident[EI_CLASS] = ELFCLASS64;
  header.e_phoff = sizeof header;
  header.e_phnum = 1;
  header.e_shentsize = sizeof(Elf64_Shdr);
  header.e_shnum = 2;
  header.e_shoff = bytes.size() - 2 * sizeof(Elf64_Shdr);
  Elf64_Phdr segment = {};
  segment.p_type = PT_LOAD;
  segment.p_offset = 120;
  segment.p_filesz = 180;
  std::memcpy(bytes.data(), &header, sizeof header);
  std::memcpy(bytes.data() + sizeof header, &segment, sizeof segment);
  return bytes;
}

TEST(CheckElfIsWhole, TakesAWholeFileAndThisProgram) {
  const testing::TempDir folder;
  WriteFileAtomically(folder / "a.so", SmallElf());
  EXPECT_NO_THROW(CheckElfIsWhole(folder / "a.so"));
  EXPECT_NO_THROW(CheckElfIsWhole("/proc/self/exe"));
}

TEST(CheckElfIsWhole, EveryTruncationIsNamed) {
  const testing::TempDir folder;
  const std::string whole = SmallElf();
  for (const size_t size :
       {size_t{0}, size_t{10}, size_t{63}, size_t{64}, size_t{119}, size_t{250}, whole.size() - 1}) {
    WriteFileAtomically(folder / "a.so", whole.substr(0, size));
    ExpectError([&] { CheckElfIsWhole(folder / "a.so"); }, "a.so is truncated");
  }
}

/// Without section headers, as after `strip --strip-section-headers`.
TEST(CheckElfIsWhole, SegmentsHaveToLieInTheFile) {
  const testing::TempDir folder;
  std::string bytes = SmallElf();
  Elf64_Ehdr header;
  std::memcpy(&header, bytes.data(), sizeof header);
  header.e_shoff = header.e_shnum = 0;
  std::memcpy(bytes.data(), &header, sizeof header);
  for (const size_t size : {size_t{300}, size_t{299}, size_t{100}}) {
    WriteFileAtomically(folder / "a.so", bytes.substr(0, size));
    if (size == 300) {
      EXPECT_NO_THROW(CheckElfIsWhole(folder / "a.so"));
    } else {
      ExpectError([&] { CheckElfIsWhole(folder / "a.so"); },
                  size == 299 ? "a part of its code" : "its program headers");
    }
  }
}

TEST(CheckElfIsWhole, OffsetsThatOverflowAreErrors) {
  const testing::TempDir folder;
  std::string bytes = SmallElf();
  Elf64_Ehdr header;
  std::memcpy(&header, bytes.data(), sizeof header);
  header.e_shoff = ~uint64_t{0};
  std::memcpy(bytes.data(), &header, sizeof header);
  WriteFileAtomically(folder / "a.so", bytes);
  ExpectError([&] { CheckElfIsWhole(folder / "a.so"); }, "lacks its section headers");
}

TEST(CheckElfIsWhole, OtherFilesAreNoLibrary) {
  const testing::TempDir folder;
  WriteFileAtomically(folder / "a.so", std::string(200, 'x'));
  ExpectError([&] { CheckElfIsWhole(folder / "a.so"); }, "is no shared library");
}

}  // namespace
}  // namespace daumier::systems
