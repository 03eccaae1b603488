#pragma once
#include "core/json.h"
#include "core/options.h"

#include <cstdint>
#include <string>

/// What every training has in common (train/optimiser.h, train/trainer.h), as plain data: options and summary.
namespace daumier {

struct OptimiserOptions {
  std::string kind = "adamw";
  double learning_rate = 1e-3;
  double weight_decay = 1e-4;
  double beta1 = 0.9;
  double beta2 = 0.999;
  double clip_norm = 0;
  double warm_up = 0.05;
  double final_rate = 0.01;

  template <class V>
  void Visit(V&& visit) {
    visit("kind", kind, Choices{{"adamw", "sgd"}}, "AdamW, or gradient descent with momentum.");
    visit("learning_rate", learning_rate, Range{0, 10}, "Step size at its peak, after the warm-up.");
    visit("weight_decay", weight_decay, Range{0, 10},
          "Share of a weight (not of a bias) that a step of rate 1 takes away.");
    visit("beta1", beta1, Range{0, 0.9999}, "Memory of the mean gradient; the momentum of sgd.");
    visit("beta2", beta2, Range{0, 0.999999}, "Memory of the mean squared gradient, of adamw alone.");
    visit("clip_norm", clip_norm, Range{0, 1e6},
          "Gradients are scaled down to this norm where they exceed it; 0: never.");
    visit("warm_up", warm_up, Range{0, 1}, "Share of all steps in which the rate climbs linearly to its peak.");
    visit("final_rate", final_rate, Range{0, 1}, "The rate at the end as a share of the peak; a cosine leads there.");
  }
};

struct TrainerOptions {
  int epochs = 20;
  int batch = 32;
  int accumulate = 1;
  std::string precision = "float32";
  int validate_every = 1;
  int patience = 0;
  int log_every = 10;
  int checkpoint_every = 0;

  template <class V>
  void Visit(V&& visit) {
    visit("epochs", epochs, Range{1, 1e6}, "Number of passes through the training samples.");
    visit("batch", batch, Range{1, 65536},
          "Samples of a batch; those left over at the end of an epoch are skipped in it.");
    visit("accumulate", accumulate, Range{1, 65536},
          "Batches a step, whose gradients are averaged: without batch norm equal to one batch of their total size.");
    visit(
        "precision", precision, Choices{{"float32", "bfloat16", "auto", "force-bfloat16"}},
        "Of the network's convolutions and matrix products in a step. bfloat16 is for GPUs and for processors with AMX "
        "or AVX-512 bfloat16; others are slow and inexact at it and refuse it unless it is forced. auto: bfloat16 on "
        "such a processor, else float32; a run keeps what it began with. Weights, losses, validation and all that "
        "reads a run are float32.");
    visit("validate_every", validate_every, Range{1, 1e6},
          "Epochs between validations, of which best weights are chosen; the last epoch is validated too.");
    visit("patience", patience, Range{0, 1e6},
          "Stop after this number of epochs of the last stage without a better validation; 0: never.");
    visit("log_every", log_every, Range{1, 1e6}, "Steps over which a line of training loss is averaged.");
    visit("checkpoint_every", checkpoint_every, Range{0, 1e6},
          "Steps between checkpoints, in addition to the one after every validation; 0: none.");
  }
};

/// How a training ended.
struct TrainingSummary {
  int64_t steps = 0;
  int64_t epochs = 0;  ///< Finished ones.
  bool stopped_early = false;
  std::string metric;
  double best = 0;
  int64_t best_epoch = 0;
  double seconds = 0;  ///< Of training, across resumes.
};

/// `config`, resolved, with the folders under `data` absolute. @throws UsageError naming `where` if one is missing.
Json WithAbsoluteData(Json config, const std::string& where);

/// A config of an earlier version, which has `product` in the place of `system`, as one of today; others unchanged.
Json WithSystemKey(Json config);

/// The task of a training config: its `system`; of configs of earlier versions `product`, or "sketch". @throws
/// UsageError naming `where` if that is no text.
std::string SystemOfConfig(const Json& config, const std::string& where);

/// The options of a training with WithSystemKey and WithAbsoluteData. @throws UsageError as ParseOptions.
template <class Options>
Options ParseTraining(const Json& config, const std::string& where) {
  const Json resolved = ToJson(ParseOptions<Options>(WithSystemKey(config), where));
  return ParseOptions<Options>(WithAbsoluteData(resolved, where), where);
}

}  // namespace daumier
