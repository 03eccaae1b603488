#pragma once
#include <cstdint>
#include <string_view>

namespace daumier {

/// CRC-32C [Castagnoli et al. 1993], as in TensorBoard's event files: reflected polynomial 0x82f63b78, initial and
/// final complement. Crc32c("123456789") = 0xe3069283.
uint32_t Crc32c(std::string_view bytes);

}  // namespace daumier
