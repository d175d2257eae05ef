// Converts a glTF file: node convert_model.mjs smaller|etc1s|uastc|uastc-zstd|plain IN OUT. For tools/ci/converters, which
// installs the packages.
import {NodeIO} from '@gltf-transform/core';
import {ALL_EXTENSIONS, KHRTextureBasisu} from '@gltf-transform/extensions';
import {textureCompress} from '@gltf-transform/functions';
import {createDefaultContainer, write} from 'ktx-parse';
import {ktx2} from 'ktx2-encoder/gltf-transform';
import {MeshoptDecoder, MeshoptEncoder} from 'meshoptimizer';
import sharp from 'sharp';

const [kind, source, target] = process.argv.slice(2);

async function imageDecoder(bytes) {
  const {data, info} = await sharp(bytes).ensureAlpha().raw().toBuffer({resolveWithObject: true});
  return {data: new Uint8Array(data), width: info.width, height: info.height};
}

// RGBA texels as they are, which KHR_texture_basisu does not ask readers to know.
async function plainKtx2(document) {
  document.createExtension(KHRTextureBasisu).setRequired(true);
  for (const texture of document.getRoot().listTextures()) {
    const {data, width, height} = await imageDecoder(texture.getImage());
    const container = createDefaultContainer();
    container.vkFormat = 37;
    container.pixelWidth = width;
    container.pixelHeight = height;
    container.levels = [{levelData: data, uncompressedByteLength: data.length}];
    texture.setImage(write(container)).setMimeType('image/ktx2');
  }
}

const options = {generateMipmap: true, imageDecoder};
const conversions = {
  smaller: () => textureCompress({encoder: sharp, targetFormat: 'png', resize: [1024, 1024]}),
  etc1s: () => ktx2({...options, isUASTC: false, qualityLevel: 255, compressionLevel: 2}),
  uastc: () => ktx2({...options, isUASTC: true, needSupercompression: false}),
  'uastc-zstd': () => ktx2({...options, isUASTC: true, needSupercompression: true}),
  plain: () => plainKtx2,
};

await Promise.all([MeshoptDecoder.ready, MeshoptEncoder.ready]);
const io = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({
  'meshopt.decoder': MeshoptDecoder,
  'meshopt.encoder': MeshoptEncoder,
});
const document = await io.read(source);
await document.transform(conversions[kind]());
await io.write(target, document);
