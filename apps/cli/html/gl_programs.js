// Shaders, and what WebGL needs to run them.

const kGround = `
uniform vec3 uTop, uBottom;
uniform vec2 uViewport;
vec3 ground() { return mix(uBottom, uTop, smoothstep(0.0, 1.0, gl_FragCoord.y / uViewport.y)); }`;

export const kGroundShader = {
  vertex: `#version 300 es
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.9999999, 1); }`,
  fragment: `#version 300 es
precision highp float;
out vec4 color;
${kGround}
void main() { color = vec4(ground(), 1); }`,
};

/** Matte clay in a head light, a little sky from above; lamps shine evenly. */
export const kMeshShader = {
  vertex: `#version 300 es
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 uMatrix;
out vec3 vPosition, vNormal;
void main() {
  vPosition = position;
  vNormal = normal;
  gl_Position = uMatrix * vec4(position, 1);
}`,
  fragment: `#version 300 es
precision highp float;
in vec3 vPosition, vNormal;
uniform vec3 uEye, uAxis, uColor, uBack;
uniform float uOpacity, uVeil;
uniform bool uLamp, uBackFaces;
out vec4 color;
${kGround}
void main() {
  vec3 view = normalize(uEye - vPosition);
  vec3 n = normalize(vNormal);
  float facing = dot(n, view);
  if (facing < 0.0) n = -n;
  float head = abs(facing), sky = 0.5 + 0.5 * dot(n, uAxis);
  vec3 base = uBackFaces ? uBack : uColor;
  vec3 shade = uLamp ? uColor : base * (0.24 + 0.56 * pow(head, 0.8) + 0.26 * sky);
  if (uBackFaces) color = vec4(shade, uVeil);
  else color = vec4(mix(ground(), shade, uLamp ? max(uOpacity, 0.85) : uOpacity), 1);
}`,
};

/** Lines of a width in pixels with round ends and a halo, cut at the near plane; dashes along those that ask for them. */
export const kStrokeShader = {
  vertex: `#version 300 es
layout(location = 0) in vec3 start;
layout(location = 1) in vec3 end;
layout(location = 2) in vec4 tint;
layout(location = 3) in vec3 shape;  // width, halo, length of a dash (pixels; 0: none)
uniform mat4 uMatrix;
uniform vec2 uSize;
uniform float uScale;
out vec2 vAt;
out vec4 vTint;
flat out vec4 vShape;  // half width, halo, dash, length
void main() {
  vec4 a = uMatrix * vec4(start, 1), b = uMatrix * vec4(end, 1);
  float da = a.z + a.w, db = b.z + b.w;
  gl_Position = vec4(2, 2, 2, 1);
  if (da <= 0.0 && db <= 0.0) return;
  if (da <= 0.0) a = mix(a, b, (da - 1e-6) / (da - db));
  else if (db <= 0.0) b = mix(b, a, (db - 1e-6) / (db - da));
  vec2 pa = a.xy / a.w * uSize * 0.5, pb = b.xy / b.w * uSize * 0.5;
  float span = distance(pa, pb);
  vec2 along = span > 1e-3 ? (pb - pa) / span : vec2(1, 0), across = vec2(-along.y, along.x);
  float radius = (shape.x * 0.5 + shape.y) * uScale + 1.0;
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vAt = vec2(mix(-radius, span + radius, corner.x), mix(-radius, radius, corner.y));
  vec2 p = pa + along * vAt.x + across * vAt.y;
  float t = span > 1e-3 ? clamp(vAt.x / span, 0.0, 1.0) : corner.x;
  gl_Position = vec4(p / (uSize * 0.5), mix(a.z / a.w, b.z / b.w, t), 1);
  vTint = tint;
  vShape = vec4(shape.x * 0.5 * uScale, shape.y * uScale, shape.z * uScale, span);
}`,
  fragment: `#version 300 es
precision highp float;
in vec2 vAt;
in vec4 vTint;
flat in vec4 vShape;
uniform vec3 uHalo;
uniform float uStrength;
out vec4 color;
void main() {
  float past = vAt.x - clamp(vAt.x, 0.0, vShape.w);
  float d = length(vec2(past, vAt.y)) - vShape.x;
  if (vShape.z > 0.0) {
    float period = 2.0 * vShape.z, from = abs(mod(vAt.x, period) - 0.5 * vShape.z - vShape.x);
    d = max(d, from - 0.5 * vShape.z);
  }
  float core = clamp(0.5 - d, 0.0, 1.0), whole = clamp(0.5 - d + vShape.y, 0.0, 1.0);
  float alpha = max(core, whole * (vShape.y > 0.0 ? 0.75 : 0.0));
  if (alpha <= 0.0) discard;
  color = vec4(mix(uHalo, vTint.rgb, core), alpha * vTint.a * uStrength);
}`,
};

export function makeProgram(gl, source) {
  const program = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, source.vertex], [gl.FRAGMENT_SHADER, source.fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    const logs = gl.getAttachedShaders(program).map((shader) => gl.getShaderInfoLog(shader));
    throw new Error("a shader of this page does not work here: " + gl.getProgramInfoLog(program) + logs.join(""));
  }
  const uniforms = {};
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS);
  for (let i = 0; i < count; ++i) {
    const { name } = gl.getActiveUniform(program, i);
    uniforms[name] = gl.getUniformLocation(program, name);
  }
  return { program, uniforms };
}

/** Floats in a buffer, and how attributes find them: [location, components] in their order; one entry per instance or vertex. */
export function makeArray(gl, floats, layout, perInstance) {
  const array = gl.createVertexArray(), buffer = gl.createBuffer();
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ARRAY_BUFFER, floats, gl.STATIC_DRAW);
  const stride = layout.reduce((sum, [, components]) => sum + components, 0);
  let offset = 0;
  for (const [location, components] of layout) {
    gl.enableVertexAttribArray(location);
    gl.vertexAttribPointer(location, components, gl.FLOAT, false, 4 * stride, 4 * offset);
    gl.vertexAttribDivisor(location, perInstance ? 1 : 0);
    offset += components;
  }
  gl.bindVertexArray(null);
  return { array, buffer, count: floats.length / stride };
}

export function deleteArray(gl, made) {
  if (!made) return;
  gl.deleteVertexArray(made.array);
  gl.deleteBuffer(made.buffer);
}
