// Surfaces of the scenes: matt bodies, and ground with metre lines that fades into the background. A wall that stands
// between the reader and what happens shows its lines only.
import { Color, DoubleSide, LineBasicMaterial, MeshLambertMaterial } from 'three';

const kVertexHead = `#include <common>
varying vec3 vWorld;`;
const kVertexBody = `#include <project_vertex>
vec4 worldPoint = vec4(transformed, 1.0);
#ifdef USE_INSTANCING
worldPoint = instanceMatrix * worldPoint;
#endif
vWorld = (modelMatrix * worldPoint).xyz;`;
const kFragmentHead = `#include <common>
varying vec3 vWorld;
uniform vec3 gridColour, horizon, gridCentre;
uniform float gridStep, fadeBegin, fadeEnd;
float gridLine(vec2 at) {
  vec2 width = fwidth(at), away = abs(fract(at - 0.5) - 0.5) / max(width, vec2(1e-6));
  vec2 line = (1.0 - min(away, 1.0)) * clamp(0.5 / max(width, vec2(1e-6)) - 0.6, 0.0, 1.0);
  return max(line.x, line.y);
}
float fade() { return smoothstep(fadeBegin, fadeEnd, distance(vWorld, gridCentre)); }`;
// The two axes along the surface carry the lines: the normal of the face decides which two.
const kFragmentGrid = `#include <color_fragment>
vec3 outward = normalize(cross(dFdx(vWorld), dFdy(vWorld)));
vec3 facing = abs(outward);
vec2 along = facing.y > 0.5 ? vWorld.xz : facing.x > facing.z ? vWorld.yz : vWorld.xy;
float lines = 0.55 * gridLine(along / gridStep) + 0.25 * gridLine(along / (gridStep * 5.0));
diffuseColor.rgb = mix(diffuseColor.rgb, gridColour, lines);
#ifndef OPEN
outward *= sign(dot(outward, cameraPosition - vWorld));
bool between = facing.y < 0.3 && dot(outward, gridCentre - vWorld) < 0.0;
if (between && gridLine(along / (gridStep * 5.0)) < 0.5) discard;
#endif`;
const kFragmentFade = `gl_FragColor.rgb = mix(gl_FragColor.rgb, horizon, fade());
#include <colorspace_fragment>`;

/** The nearest of 1, 2, 5 times a power of ten. */
export function roundStep(length) {
  const power = 10 ** Math.floor(Math.log10(length)),
    part = length / power;
  return power * (part < 1.5 ? 1 : part < 3.5 ? 2 : part < 7.5 ? 5 : 10);
}

const kLeastPixels = 1.6; // of the radius of a body: what is far or tiny is still a dot
const kReachHead = `#include <common>
attribute float reach;
uniform float leastSize;`;
const kReachBody = `#include <begin_vertex>
#ifdef USE_INSTANCING
vec3 across = vec3(length(instanceMatrix[0].xyz), length(instanceMatrix[1].xyz), length(instanceMatrix[2].xyz));
float depth = -(modelViewMatrix * instanceMatrix * vec4(0.0, 0.0, 0.0, 1.0)).z;
transformed *= max(1.0, leastSize * depth / max(reach * max(across.x, max(across.y, across.z)), 1e-12));
#endif`;

export function makeMaterials(radius, centre) {
  const uniforms = {
    gridColour: { value: new Color() },
    horizon: { value: new Color() },
    gridCentre: { value: centre },
    gridStep: { value: roundStep(radius / 4) },
    fadeBegin: { value: radius * 2.5 },
    fadeEnd: { value: radius * 9 },
  };
  // Faces lie a little behind their own edges, which they would break up otherwise.
  const behindEdges = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
  const ground = new MeshLambertMaterial(behindEdges),
    openGround = new MeshLambertMaterial({ side: DoubleSide, ...behindEdges });
  openGround.defines = { ...openGround.defines, OPEN: '' };
  ground.onBeforeCompile = openGround.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', kVertexHead)
      .replace('#include <project_vertex>', kVertexBody);
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', kFragmentHead)
      .replace('#include <color_fragment>', kFragmentGrid)
      .replace('#include <colorspace_fragment>', kFragmentFade);
  };
  const body = new MeshLambertMaterial(behindEdges),
    openBody = new MeshLambertMaterial({ side: DoubleSide, ...behindEdges });
  const leastSize = { value: 0 };
  body.onBeforeCompile = openBody.onBeforeCompile = (shader) => {
    shader.uniforms.leastSize = leastSize;
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', kReachHead)
      .replace('#include <begin_vertex>', kReachBody);
  };
  const edge = new LineBasicMaterial({ transparent: true, opacity: 0.35, depthWrite: false });
  const fixedEdge = new LineBasicMaterial({ transparent: true, opacity: 0.22, depthWrite: false });
  return {
    ground,
    openGround,
    body,
    openBody,
    edge,
    fixedEdge,
    gridStep: uniforms.gridStep.value,
    /** metres: that a pixel covers at 1 m from the camera. */
    keepVisible(metres) {
      leastSize.value = metres * kLeastPixels;
    },
    paint(theme) {
      uniforms.gridColour.value.copy(theme.gridLine);
      uniforms.horizon.value.copy(theme.horizon);
      for (const material of [ground, openGround]) material.color.copy(theme.ground);
      for (const line of [edge, fixedEdge]) line.color.copy(theme.edge);
    },
    dispose() {
      for (const material of [ground, openGround, body, openBody, edge, fixedEdge]) material.dispose();
    },
  };
}
