#include "models/vertex_normals.h"

#include "core/error.h"
#include "tensor/shape.h"

#include <ATen/Dispatch.h>
#include <ATen/Functions.h>
#include <ATen/Parallel.h>
#include <torch/csrc/autograd/custom_function.h>

#include <cmath>
#include <vector>

namespace daumier::models {
namespace {

template <class T>
struct Three {
  T x, y, z;
};
template <class T>
Three<T> At(const T* points, int vertex) {
  return {points[3 * vertex], points[3 * vertex + 1], points[3 * vertex + 2]};
}
template <class T>
Three<T> Minus(const Three<T>& a, const Three<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
Three<T> CrossProduct(const Three<T>& a, const Three<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T Dot(const Three<T>& a, const Three<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
void Add(T* points, int vertex, const Three<T>& by) {
  points[3 * vertex] += by.x;
  points[3 * vertex + 1] += by.y;
  points[3 * vertex + 2] += by.z;
}

template <class T>
constexpr T kLeastLength = std::is_same_v<T, float> ? T(1e-20) : T(1e-200);

/// The gradient g of a vector v / |v| as that of v: (g - n (n . g)) / |v|.
template <class T>
Three<T> ThroughLength(const Three<T>& v, const Three<T>& g) {
  const T length = std::sqrt(Dot(v, v));
  if (!(length > kLeastLength<T>)) return {0, 0, 0};
  const Three<T> n{v.x / length, v.y / length, v.z / length};
  const T along = Dot(n, g);
  return {(g.x - n.x * along) / length, (g.y - n.y * along) / length, (g.z - n.z * along) / length};
}

/// sums (V, 3): of the unit normals of the triangles.
template <class T>
void SumNormals(const T* vertices, const int* triangles, int64_t num_triangles, T* sums) {
  for (int64_t t = 0; t < num_triangles; ++t) {
    const int a = triangles[3 * t], b = triangles[3 * t + 1], c = triangles[3 * t + 2];
    const Three<T> p = At(vertices, a);
    Three<T> n = CrossProduct(Minus(At(vertices, b), p), Minus(At(vertices, c), p));
    const T length = std::sqrt(Dot(n, n));
    if (!(length > kLeastLength<T>)) continue;
    n = {n.x / length, n.y / length, n.z / length};
    for (const int vertex : {a, b, c}) Add(sums, vertex, n);
  }
}

template <class T>
void SpreadGradient(const T* vertices, const int* triangles, int64_t num_triangles, const T* sum_gradient,
                    T* vertex_gradient) {
  for (int64_t t = 0; t < num_triangles; ++t) {
    const int a = triangles[3 * t], b = triangles[3 * t + 1], c = triangles[3 * t + 2];
    const Three<T> p = At(vertices, a), u = Minus(At(vertices, b), p), v = Minus(At(vertices, c), p);
    const Three<T> ga = At(sum_gradient, a), gb = At(sum_gradient, b), gc = At(sum_gradient, c);
    const Three<T> g =
        ThroughLength(CrossProduct(u, v), Three<T>{ga.x + gb.x + gc.x, ga.y + gb.y + gc.y, ga.z + gb.z + gc.z});
    // n = u x v: du has the gradient v x g, dv has g x u.
    const Three<T> gu = CrossProduct(v, g), gv = CrossProduct(g, u);
    Add(vertex_gradient, b, gu);
    Add(vertex_gradient, c, gv);
    Add(vertex_gradient, a, Three<T>{-gu.x - gv.x, -gu.y - gv.y, -gu.z - gv.z});
  }
}

class NormalsFunction : public torch::autograd::Function<NormalsFunction> {
 public:
  static torch::Tensor forward(torch::autograd::AutogradContext* context, const torch::Tensor& vertices,
                               const torch::Tensor& triangles) {
    const int64_t batch = vertices.size(0), count = vertices.size(1), num_triangles = triangles.size(0);
    torch::Tensor sums = at::zeros_like(vertices), normals = at::empty_like(vertices);
    AT_DISPATCH_FLOATING_TYPES(vertices.scalar_type(), "VertexNormals", [&] {
      const scalar_t* const points = vertices.data_ptr<scalar_t>();
      scalar_t *const s = sums.data_ptr<scalar_t>(), *const n = normals.data_ptr<scalar_t>();
      const int* const corners = triangles.data_ptr<int>();
      at::parallel_for(0, batch, 1, [&](int64_t begin, int64_t end) {
        for (int64_t b = begin; b < end; ++b) {
          SumNormals(points + 3 * count * b, corners, num_triangles, s + 3 * count * b);
          for (int64_t v = count * b; v < count * (b + 1); ++v) {
            const Three<scalar_t> sum = At(s, int(v));
            const scalar_t length = std::sqrt(Dot(sum, sum));
            const scalar_t factor = length > kLeastLength<scalar_t> ? 1 / length : scalar_t(0);
            n[3 * v] = factor * sum.x;
            n[3 * v + 1] = factor * sum.y;
            n[3 * v + 2] = factor * sum.z;
          }
        }
      });
    });
    context->save_for_backward({vertices, triangles, sums});
    return normals;
  }

  static torch::autograd::variable_list backward(torch::autograd::AutogradContext* context,
                                                 const torch::autograd::variable_list& gradients) {
    const auto saved = context->get_saved_variables();
    const torch::Tensor &vertices = saved[0], &triangles = saved[1], &sums = saved[2];
    const torch::Tensor of_normals = gradients[0].contiguous();
    const int64_t batch = vertices.size(0), count = vertices.size(1), num_triangles = triangles.size(0);
    torch::Tensor result = at::zeros_like(vertices);
    AT_DISPATCH_FLOATING_TYPES(vertices.scalar_type(), "VertexNormals", [&] {
      const scalar_t *const points = vertices.data_ptr<scalar_t>(), *const s = sums.data_ptr<scalar_t>(),
                            *const g = of_normals.data_ptr<scalar_t>();
      scalar_t* const out = result.data_ptr<scalar_t>();
      const int* const corners = triangles.data_ptr<int>();
      at::parallel_for(0, batch, 1, [&](int64_t begin, int64_t end) {
        std::vector<scalar_t> of_sums(size_t(3 * count));
        for (int64_t b = begin; b < end; ++b) {
          const int64_t first = 3 * count * b;
          for (int64_t v = 0; v < count; ++v) {
            const Three<scalar_t> through = ThroughLength(At(s + first, int(v)), At(g + first, int(v)));
            of_sums[size_t(3 * v)] = through.x;
            of_sums[size_t(3 * v + 1)] = through.y;
            of_sums[size_t(3 * v + 2)] = through.z;
          }
          SpreadGradient(points + first, corners, num_triangles, of_sums.data(), out + first);
        }
      });
    });
    return {result, {}};
  }
};

}  // namespace

torch::Tensor VertexNormals(const torch::Tensor& vertices, const torch::Tensor& triangles) {
  tensor::CheckShape(vertices, {tensor::kAny, tensor::kAny, 3}, "vertices");
  tensor::CheckShape(triangles, {tensor::kAny, 3}, "triangles");
  DAUMIER_CHECK(triangles.scalar_type() == at::kInt && triangles.is_cpu() && vertices.is_cpu(),
                "vertex normals need triangles of int32 and both on the CPU");
  DAUMIER_CHECK(triangles.numel() == 0 ||
                    (triangles.min().item<int>() >= 0 && int64_t(triangles.max().item<int>()) < vertices.size(1)),
                "a triangle has a corner that is not among {} vertices", vertices.size(1));
  return NormalsFunction::apply(vertices.contiguous(), triangles.contiguous());
}

}  // namespace daumier::models
