// Reads DICOM objects with the code of OHIF (dcmjs, @cornerstonejs/adapters) and writes what comes out as JSON:
//   node readers.mjs sr FILE         {"Length": [{"stats": {...}, "points": [[x, y, z], ...]}, ...], ...}
//   node readers.mjs seg FILE FOLDER {"voxels": {"1": COUNT, ...}}, on the images of FOLDER
// Positions of shapes in pixels are given as if pixel 0, 0 lay at 0, 0, 0 and pixels had 1 mm.
import fs from "node:fs";
import path from "node:path";

// What the libraries touch of a browser as they are loaded.
globalThis.window = globalThis.self = globalThis;
globalThis.document = {
  createElement: () => ({ getContext: () => null, style: {}, addEventListener() {} }),
  addEventListener() {},
  documentElement: { style: {} },
  body: {},
};
console.log = console.info = console.warn = () => {};

const { default: dcmjs } = await import("dcmjs");
const { adaptersSR, adaptersSEG } = await import("@cornerstonejs/adapters");
const { metaData } = await import("@cornerstonejs/core");

const bytesOf = (file) => {
  const buffer = fs.readFileSync(file);
  return buffer.buffer.slice(buffer.byteOffset, buffer.byteOffset + buffer.byteLength);
};
const datasetOf = (file) => {
  const { DicomMessage, DicomMetaDictionary } = dcmjs.data;
  const message = DicomMessage.readFile(bytesOf(file), { ignoreErrors: true });
  const dataset = DicomMetaDictionary.naturalizeDataset(message.dict);
  dataset._meta = DicomMetaDictionary.namifyDataset(message.meta);
  return dataset;
};

function sr(file) {
  const plane = {
    imagePositionPatient: [0, 0, 0], rowCosines: [1, 0, 0], columnCosines: [0, 1, 0],
    rowPixelSpacing: 1, columnPixelSpacing: 1,
  };
  metaData.addProvider((type) => (type === "imagePlaneModule" ? plane : undefined), 1);
  const everyImage = new Proxy({}, { get: (_, uid) => `image:${String(uid)}` });
  const state = adaptersSR.Cornerstone3D.MeasurementReport.generateToolState(datasetOf(file), everyImage, metaData);
  const out = {};
  for (const [tool, measurements] of Object.entries(state))
    out[tool] = measurements.map(({ annotation }) => ({
      stats: Object.values(annotation.data.cachedStats ?? {})[0] ?? {},
      points: annotation.data.handles?.points ?? annotation.data.contour?.polyline ?? [],
      finding: annotation.data.label ?? annotation.metadata?.label,
    }));
  return out;
}

async function seg(file, folder) {
  const images = fs.readdirSync(folder).map((name) => datasetOf(path.join(folder, name)));
  const normal = (d) => {
    const [a, b, c, p, q, r] = d.ImageOrientationPatient;
    const [x, y, z] = d.ImagePositionPatient;
    return x * (b * r - c * q) + y * (c * p - a * r) + z * (a * q - b * p);
  };
  images.sort((a, b) => normal(a) - normal(b));
  const byId = new Map(images.map((d) => [`image:${d.SOPInstanceUID}`, d]));
  const provider = {
    get(type, id) {
      const d = byId.get(id);
      if (!d) return undefined;
      const modules = {
        instance: d,
        generalImageModule: { sopInstanceUID: d.SOPInstanceUID },
        generalSeriesModule: { modality: d.Modality, seriesInstanceUID: d.SeriesInstanceUID },
        imagePlaneModule: {
          rows: d.Rows, columns: d.Columns, imageOrientationPatient: d.ImageOrientationPatient,
          imagePositionPatient: d.ImagePositionPatient, frameOfReferenceUID: d.FrameOfReferenceUID,
          rowCosines: d.ImageOrientationPatient.slice(0, 3), columnCosines: d.ImageOrientationPatient.slice(3),
          rowPixelSpacing: d.PixelSpacing[0], columnPixelSpacing: d.PixelSpacing[1], sliceThickness: d.SliceThickness,
        },
      };
      return modules[type];
    },
  };
  metaData.addProvider((type, id) => provider.get(type, id), 1);
  const made = await adaptersSEG.Cornerstone3D.Segmentation.createFromDICOMSegBuffer([...byId.keys()], bytesOf(file), {
    metadataProvider: provider,
  });
  const voxels = {};
  for (const group of made.labelMapImages)
    for (const image of group)
      for (const value of image.voxelManager?.getScalarData?.() ?? image.getPixelData())
        if (value) voxels[value] = (voxels[value] ?? 0) + 1;
  return { voxels };
}

const [kind, file, folder] = process.argv.slice(2);
process.stdout.write(JSON.stringify(kind === "seg" ? await seg(file, folder) : sr(file)) + "\n");
process.exit(0);
