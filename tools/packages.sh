# The Debian packages that Daumier needs, one list for ./dev setup, ./dev try and tools/debian13.sh. Sourced, not run.
# What the program needs that predicts and does not train:
program_packages="libdnnl-dev libopenblas-dev libeigen3-dev libceres-dev liblinear-dev libarchive-dev zlib1g-dev libhdf5-dev libnanoflann-dev libspectra-dev
  libpugixml-dev libmeshoptimizer-dev libpng-dev libjpeg62-turbo-dev libssl-dev libcpp-httplib-dev libcli11-dev libtomlplusplus-dev libspdlog-dev libfmt-dev nlohmann-json3-dev"
try_packages="ca-certificates clang cmake ninja-build mold libopencv-imgproc-dev libopencv-imgcodecs-dev $program_packages"
build_packages="ca-certificates git g++ clang clang-format clang-tidy cmake ninja-build ccache mold pkg-config xz-utils chromium python3-numpy"
library_packages="$program_packages libtorch-dev libopencv-dev libonnx-dev libprotobuf-dev protobuf-compiler libgtest-dev libgmock-dev libbenchmark-dev"
# Debian packages of ./dev setup --all alone, for tools/consumers/; others there are from npm (tools/npm-consumers/).
consumer_packages="blender gltfpack libassimp-dev"
