#include "io/deidentify/descriptor_words.h"

#include <QString>
#include <algorithm>
#include <set>

namespace volumen {

namespace {

// Lower case, separated by blanks.
constexpr const char* list =
    "2d 3d 4d abd abdo abdomen abdominal ac acute adc adrenal angio angiogram angiography ankle anterior "
    "aorta aortic ap apex arm arms arterial artery asl assessment atrial attenuation average avg ax axial "
    "axis b bilateral biopsy blood body bold bolus bone bones bowel brain breast breath bronchus c "
    "calcium cardiac carotid cbf cbv cc ce cect cerebral cervical chest cine clavicle clinical co coccyx "
    "colon colonography colour comparison contrast cor coronal coronary corrected correction cr cranial "
    "ct cta cube cxr d deep delayed derived diastole diffusion dir dixon dose drr dti dual dwi dx dyn "
    "dynamic early ecg echo elbow emission enhanced enterography epi equilibrium esophagus exam "
    "expiration expiratory extremity eyes face facial fast fat fatsat fbp fdg feet femur fetal field "
    "fiesta filtered fine finger first flair flash flow fluoro fluoroscopy follow foot forearm frame "
    "frames from frontal fs fse full functional fused gad gated gd gradient gre guided hand hard haste "
    "head heart helical hemorrhage hepatic high hip hips hr hres humerus iac image images imaging in "
    "infarct inferior initial inner inspiration internal inv ir iso joint k kernel kidney kidneys knee l "
    "lao larynx last lat late lateral left leg legs lesion lesions limited liver loc localiser localizer "
    "long low lower ls lspine lumbar lung lungs lymph mag magnitude mammo mammogram mammography mandible "
    "map maxilla mean medial mediastinum medium minip mip mlo mm mono motion mp mpr mprage mr mra mrcp "
    "mri mrv ms mtt multi multiphase muscle myocardial nasal nativ native neck nerve nm no node nodule "
    "non noncontrast normal nose obl oblique of off on opp optic oral orbit orbits organ original os out "
    "ovary overview pa pancreas parallel parotid patella pc pcr pd pdw pe pediatric pelvic pelvis perf "
    "perfusion pet petct phase phases pituitary plain plane planes planning portable portal post "
    "posterior pre prone prostate protocol proton pulmonary qc r radius rao rapid raw recon "
    "reconstruction rectum reformat reformatted region renal report research resp rest restage rib ribs "
    "right routine rt s sacral sacroiliac sacrum sag sagittal sat scan scaphoid scapula scout screen "
    "screening se secondary segmentation sense sequence series short shoulder sinus sinuses skeletal skin "
    "skull slab slice slices small soft space spect spgr spin spine spiral spleen ss staging standard "
    "standing static std stenosis sternum stir stomach stone stress study sub subtraction sup superior "
    "supine suv swi systole t t1 t1w t2 t2star t2w te temporal tfe thick thigh thin thoracic thorax three "
    "thyroid tibia time tir tissue tmj to toe tof topogram torso total trace tracer trachea transverse "
    "trauma true tse tumor tumour turbo two type uld ultra ultrasound unenhanced upper ureter urinary "
    "urography us uterine uterus v vascular vein veins venous ventricle vessel vessels vibe view views "
    "vol volume volumetric w wall water wb wh whole width window with without wo wrist xa xr years z zoom ";

bool isShortNumber(const QString& word) {
  constexpr qsizetype mostDigits = 3;
  return word.size() <= mostDigits &&
         std::ranges::all_of(word, [](QChar c) { return c >= u'0' && c <= u'9'; });
}

}  // namespace

std::string knownWordsOf(const std::string& description) {
  static const std::set<QString> known = [] {
    const QStringList words = QString::fromLatin1(list).split(QLatin1Char(' '), Qt::SkipEmptyParts);
    return std::set<QString>(words.begin(), words.end());
  }();
  QString kept, word;
  const auto endWord = [&] {
    if (!word.isEmpty() && (known.contains(word.toLower()) || isShortNumber(word)))
      kept += (kept.isEmpty() ? QString() : QStringLiteral(" ")) + word;
    word.clear();
  };
  for (const QChar c : QString::fromStdString(description)) {
    if (c.isLetterOrNumber())
      word += c;
    else
      endWord();
  }
  endWord();
  return kept.toStdString();
}

}  // namespace volumen
