#include "systems/elf_file.h"

#include "core/error.h"

#include <elf.h>

#include <cstring>
#include <fstream>

namespace daumier::systems {
namespace {

/// Whether `count` entries of `entry_size` bytes from `offset` on lie in the file.
bool FitsIn(uint64_t file_size, uint64_t offset, uint64_t count, uint64_t entry_size) {
  return offset <= file_size && (entry_size == 0 || count <= (file_size - offset) / entry_size);
}

}  // namespace

void CheckElfIsWhole(const std::filesystem::path& path) {
  const uint64_t size = std::filesystem::file_size(path);
  std::ifstream file(path, std::ios::binary);
  const auto check = [&](bool is_whole, const char* missing) {
    DAUMIER_CHECK(is_whole, "{} is truncated: it has {} bytes and lacks {}", path.string(), size, missing);
  };
  Elf64_Ehdr header = {};
  check(bool(file.read(reinterpret_cast<char*>(&header), sizeof header)), "its header");
  DAUMIER_CHECK(std::memcmp(header.e_ident, ELFMAG, SELFMAG) == 0 && header.e_ident[EI_CLASS] == ELFCLASS64,
                "{} is no shared library (expected an ELF file of 64 bits)", path.string());
  check(FitsIn(size, header.e_shoff, header.e_shnum, header.e_shentsize), "its section headers");
  check(FitsIn(size, header.e_phoff, header.e_phnum, sizeof(Elf64_Phdr)), "its program headers");
  file.seekg(std::streamoff(header.e_phoff));
  for (int i = 0; i < header.e_phnum; ++i) {
    Elf64_Phdr segment = {};
    check(bool(file.read(reinterpret_cast<char*>(&segment), sizeof segment)), "its program headers");
    check(segment.p_type != PT_LOAD || FitsIn(size, segment.p_offset, segment.p_filesz, 1), "a part of its code");
  }
}

}  // namespace daumier::systems
