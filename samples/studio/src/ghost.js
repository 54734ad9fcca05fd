// The body at rest as a ghost around the posed one: clear where it faces the eye, seen at its outline.
import * as THREE from 'three';

export function ghostOf(positions, triangles) {
  const geometry = new THREE.BufferGeometry();
  geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
  geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
  const material = new THREE.ShaderMaterial({
    transparent: true,
    depthWrite: false,
    // where the pose left the surface at rest, the body hides its ghost
    polygonOffset: true,
    polygonOffsetFactor: 2,
    polygonOffsetUnits: 2,
    vertexShader: `varying vec3 vNormal; varying vec3 vEye;
      void main() {
        vec4 place = modelViewMatrix * vec4(position, 1.0);
        vNormal = normalMatrix * normal; vEye = -place.xyz;
        gl_Position = projectionMatrix * place;
      }`,
    fragmentShader: `varying vec3 vNormal; varying vec3 vEye;
      void main() {
        float facing = abs(dot(normalize(vNormal), normalize(vEye)));
        gl_FragColor = vec4(vec3(0.16, 0.3, 0.52), 0.08 + 0.5 * pow(1.0 - facing, 2.0));
        #include <colorspace_fragment>
      }`,
  });
  const ghost = new THREE.Mesh(geometry, material);
  ghost.frustumCulled = false;
  ghost.visible = false;
  ghost.renderOrder = 1;
  return ghost;
}
