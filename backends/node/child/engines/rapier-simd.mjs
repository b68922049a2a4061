// Rapier with SIMD: package @dimforge/rapier3d-simd-compat.
import { adapter } from './rapier.mjs';

export const { manifest, createWorld } = adapter('@dimforge/rapier3d-simd-compat');
