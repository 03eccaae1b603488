// Small runs of few faces, trained in seconds, and their exports: what `daumier export` writes, not what learns anything.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { repository } from '../../tools/consumers/studio/client.mjs';

/** {sketch, deform, portrait}: run folders; their exports are in scratch/sketch_export and so on. */
export function trainSmallModels(program, weights) {
  const at = (name) => join(program.scratch, name), config = (name) => join(repository, 'configs', name);
  const common = ['epochs=1', 'split.validation=0.25', 'split.test=0.25', `data.faces=${at('faces')}`];
  program.run('dataset', 'faces', '--config', config('faces/small.toml'), '--out', at('faces'), `source.path=${join(weights, 'face-ict')}`, 'num_persons=4', 'exaggeration.gammas=[0.0]');
  program.run('dataset', 'points', '--config', config('points/cpu.toml'), '--out', at('points'), `faces=${at('faces')}`, 'num_samples=100');
  program.run('dataset', 'sketches', '--config', config('sketches/frontal.toml'), '--out', at('sketches'), `faces=${at('faces')}`);
  program.run('train', config('deform/cpu.toml'), '--out', at('deform'), ...common, `data.points=${at('points')}`, 'validate_every=1', 'validation.newton_steps=1', 'points.num_points=64',
    'network.width=32', 'network.hyper_width=32', 'network.latent=16');
  program.run('train', config('sketch/demo.toml'), '--out', at('sketch'), ...common, `data.sketches=${at('sketches')}`, 'bilinear.num_identity=1', 'bilinear.num_expression=4');
  const source = ['source.name=ict', `source.path=${join(weights, 'face-ict')}`];
  program.run('dataset', 'portraits', '--config', config('portraits/demo.toml'), '--out', at('portraits'), `faces=${at('faces')}`, 'num_images=12', ...source);
  program.run('train', config('portrait/cpu.toml'), '--out', at('portrait'), ...common, `data.portraits=${at('portraits')}`, ...source);
  for (const name of ['deform', 'sketch', 'portrait']) program.run('export', at(name), '--out', at(`${name}_export`));
  return { sketch: at('sketch'), deform: at('deform'), portrait: at('portrait') };
}

/** x, y, z of the mean face of shipped weights. */
export function meanFaceOf(weights) {
  const bytes = readFileSync(join(weights, 'face-ict/template.safetensors')), length = Number(bytes.readBigUInt64LE(0));
  const [begin, end] = JSON.parse(bytes.toString('utf8', 8, 8 + length)).neutral.data_offsets;
  return Float64Array.from({ length: (end - begin) / 8 }, (_, i) => bytes.readDoubleLE(8 + length + begin + 8 * i));
}
