#pragma once
#include "core/parallel.h"

namespace daumier::raster {

/// Calls work(i) for the images i = 0..count-1 of a batch on all threads of the pool, each image on one thread: an idle
/// thread takes the next image. With an object of memory (ColourPicture, FacePicture) for each image the results do not
/// depend on the number of threads. The first error, in the order of i, is thrown here.
template <class Work>
void ForEachImage(int count, const Work& work, ThreadPool& pool = SharedThreadPool()) {
  RunInOrder(
      count, count, [&](int i) { work(i); }, [](int) {}, pool);
}

}  // namespace daumier::raster
