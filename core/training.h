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
    visit("learning_rate", learning_rate, Range{0, 10}, "Learning rate at its peak, after the warm-up.");
    visit("weight_decay", weight_decay, Range{0, 10},
          "Decay rate: a step at learning rate 1 removes this share of each weight; biases do not decay.");
    visit("beta1", beta1, Range{0, 0.9999}, "Decay of the running mean of gradients; the momentum of sgd.");
    visit("beta2", beta2, Range{0, 0.999999}, "Decay of the running mean of squared gradients; adamw alone.");
    visit("clip_norm", clip_norm, Range{0, 1e6},
          "Largest norm of the gradient; larger gradients are scaled down to it. 0: no limit.");
    visit("warm_up", warm_up, Range{0, 1}, "Share of all steps in which the rate climbs linearly to its peak.");
    visit("final_rate", final_rate, Range{0, 1},
          "Learning rate at the end, as a share of the peak; between peak and end it follows a cosine.");
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
          "Samples in a batch. Samples that do not fill a last batch are skipped in that epoch.");
    visit("accumulate", accumulate, Range{1, 65536},
          "Batches in a step; their gradients are averaged. Without batch norm this equals one batch of their total "
          "size.");
    visit("precision", precision, Choices{{"float32", "bfloat16", "auto", "force-bfloat16"}},
          "Number format of the network's convolutions and matrix products in a training step. bfloat16 needs a GPU or "
          "a processor with AMX or AVX-512 bfloat16; on other processors it is slow and inexact, and the program "
          "refuses it. force-bfloat16: bfloat16 without this check. auto: bfloat16 on a processor with these "
          "instructions, else float32 (also on a GPU); a resumed run keeps its format. Weights, losses, validation, "
          "evaluation and prediction are always in float32.");
    visit("validate_every", validate_every, Range{1, 1e6},
          "Epochs between validations; the last epoch is always validated. The run keeps the weights of the best "
          "validation.");
    visit("patience", patience, Range{0, 1e6},
          "Stop once this number of epochs of the last stage bring no better validation; 0: never stop early.");
    visit("log_every", log_every, Range{1, 1e6}, "Steps in one line of the log; its training loss is their mean.");
    visit("checkpoint_every", checkpoint_every, Range{0, 1e6},
          "Steps between checkpoints, in addition to the checkpoint after every validation; 0: only those.");
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
