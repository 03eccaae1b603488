#include "faces/import/hdf5_file.h"

#include "tests/faces/import/foreign_files.h"
#include "tests/support/corruption.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using testing::ExpectError;
using testing::Hdf5Writer;

class Hdf5FileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Hdf5Writer writer(path_);
    writer.Add("shape/model/mean", {6}, std::vector<float>{0, 1, 2, 3, 4, 5});
    writer.Add("shape/representer/cells", {3, 2}, std::vector<int>{0, 1, 2, 3, 4, 5});
    const std::vector<double> doubles = {0.25, -1};
    writer.Add("double", {2}, H5T_IEEE_F64BE, H5T_NATIVE_DOUBLE, doubles.data());
    const std::vector<uint8_t> bytes = {255, 7};
    writer.Add("bytes", {2}, H5T_STD_U8LE, H5T_NATIVE_UINT8, bytes.data());
    writer.Add("opaque", {2}, H5T_NATIVE_OPAQUE, H5T_NATIVE_OPAQUE, bytes.data());
  }

  testing::TempDir folder_;
  std::filesystem::path path_ = folder_ / "m.h5";
};

TEST_F(Hdf5FileTest, WantedDataSetsAreRead) {
  const NumberArrays arrays =
      ReadHdf5(path_, {"shape/model/mean", "shape/representer/cells", "double", "bytes", "no/such", "shape/none"});
  ASSERT_EQ(arrays.size(), 4u);
  EXPECT_EQ(arrays.at("shape/model/mean")[5], 5);
  EXPECT_EQ(arrays.at("shape/representer/cells").shape(), (std::vector<int64_t>{3, 2}));
  EXPECT_EQ(arrays.at("shape/representer/cells").Transposed()[1], 2);
  EXPECT_EQ(arrays.at("double")[0], 0.25);
  EXPECT_EQ(arrays.at("bytes")[0], 255);
}

TEST_F(Hdf5FileTest, NamesAtTheTopAreListed) {
  EXPECT_EQ(Hdf5Names(path_), (std::set<std::string>{"bytes", "double", "opaque", "shape"}));
  ExpectError([&] { Hdf5Names(folder_ / "none.h5"); }, "does not exist");
}

TEST_F(Hdf5FileTest, WhatIsNoNumberOrNoDataSetIsRefused) {
  ExpectError([&] { ReadHdf5(path_, {"opaque"}); }, "m.h5: opaque holds no usual numbers");
  ExpectError([&] { ReadHdf5(path_, {"shape/model"}); }, "m.h5: shape/model is no data set");
  ExpectError([&] { ReadHdf5(folder_ / "none.h5", {"a"}); }, "does not exist");
  testing::WriteQuickly(path_, "no HDF5 file");
  ExpectError([&] { ReadHdf5(path_, {"a"}); }, "cannot be opened as an HDF5 file");
}

TEST_F(Hdf5FileTest, SizesThatNoFileCanHoldAreRefused) {
  {
    Hdf5Writer writer(path_);
    writer.Add("huge", {0}, std::vector<float>{});
  }
  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hsize_t size = hsize_t{1} << 40;
  const hid_t space = H5Screate_simple(1, &size, nullptr);
  // Contiguous storage is taken from the file only when it is written.
  const hid_t data = H5Dcreate2(file, "claim", H5T_IEEE_F32LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dclose(data);
  H5Sclose(space);
  H5Fclose(file);
  ExpectError([&] { ReadHdf5(path_, {"claim"}); }, "claims 4398046511104 bytes in a file of");
}

TEST_F(Hdf5FileTest, TruncatedFilesAreRefused) {
  const std::string bytes = ReadFile(path_);
  for (size_t size = 0; size < bytes.size(); size += 61) {
    testing::WriteQuickly(path_, std::string_view(bytes).substr(0, size));
    EXPECT_THROW(ReadHdf5(path_, {"shape/model/mean"}), Error) << size;
  }
}

}  // namespace
}  // namespace daumier::faces
