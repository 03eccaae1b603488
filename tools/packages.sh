# The Debian packages that Daumier needs, one list for ./dev setup and tools/debian13.sh. Sourced, not run.
build_packages="ca-certificates git g++ clang clang-format clang-tidy cmake ninja-build ccache mold pkg-config xz-utils"
library_packages="libtorch-dev libdnnl-dev libopenblas-dev libeigen3-dev libceres-dev libopencv-dev
  libonnx-dev libprotobuf-dev protobuf-compiler libarchive-dev zlib1g-dev libhdf5-dev libnanoflann-dev libspectra-dev libpugixml-dev libmeshoptimizer-dev
  libssl-dev libcli11-dev libtomlplusplus-dev libspdlog-dev libfmt-dev nlohmann-json3-dev libgtest-dev libgmock-dev libbenchmark-dev"
# Of ./dev try: what the program needs that predicts and does not train.
try_packages="ca-certificates g++ cmake ninja-build mold libdnnl-dev libopenblas-dev libeigen3-dev libceres-dev libopencv-imgproc-dev
  libopencv-imgcodecs-dev libarchive-dev zlib1g-dev libhdf5-dev libnanoflann-dev libspectra-dev libpugixml-dev libssl-dev libcli11-dev
  libtomlplusplus-dev libspdlog-dev libfmt-dev nlohmann-json3-dev"
# Debian packages of ./dev setup --all alone, for tools/consumers/; others there are from npm (tools/npm-consumers/).
consumer_packages="blender python3-numpy gltfpack libassimp-dev chromium"
