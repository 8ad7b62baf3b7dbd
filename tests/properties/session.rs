//! From samples to a conclusion by the library alone, and results that survive being written.

use selfosc::control::{Gains, Structure, Tuning};
use selfosc::experiment::{Columns, Log, Record, Sensor, SimulatedExperiment};
use selfosc::features::{Features, RecordFeatures};
use selfosc::identify::answer::AxisParameter;
use selfosc::identify::document::RefusalDocument;
use selfosc::identify::fit::RecordFit;
use selfosc::identify::fit::joint::{FeatureRow, Joint, fit_rows};
use selfosc::identify::fit::select::likelihood::Choice;
use selfosc::identify::{
    Caution, Conclusion, Delay, DragLaw, DragVerdict, Identification, Method, Model, Reason, Refusal, Reported,
    Session, Settings, SettingsError, Stage, Term, Trust, Warning, exact, iso,
};
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::orbit::{LimitCycle, limit_cycle};
use selfosc::plant::DragAxis;
use serde::{Serialize, de::DeserializeOwned};

fn axis() -> DragAxis<f64> {
    DragAxis::quadratic(1.0, 0.5).unwrap().with_disturbance(0.05).unwrap().with_delay_s(0.1).unwrap()
}

fn relay(level: f64) -> RelayHysteresis<f64> {
    RelayHysteresis::new(level, 0.3, 0.0).unwrap()
}

fn record(level: f64) -> Record {
    SimulatedExperiment::new(axis(), relay(level), 10.0).unwrap().held().run(50.0).unwrap()
}

/// Two records, every method, estimated delay.
fn found() -> Identification {
    let settings = Settings { delay: Delay::Estimated, ..Settings::default() };
    let strong = record(2.0);
    let [time_s, output, input] = [strong.time_s(), strong.output(), strong.input()].map(<[f64]>::to_vec);
    let session = Session::new(settings).record("weak", record(1.0));
    session.samples("strong", time_s, output, input).unwrap().identify().unwrap()
}

/// What is written comes back equal; and it can be sent, shared and cloned.
fn comes_back<T: Serialize + DeserializeOwned + PartialEq + core::fmt::Debug + Clone + Send + Sync>(value: &T) {
    let text = serde_json::to_string(value).unwrap();
    assert_eq!(serde_json::from_str::<T>(&text).unwrap(), value.clone(), "{text}");
}

fn damaged<T: DeserializeOwned>(value: &impl Serialize, pointer: &str, by: serde_json::Value) -> String {
    let mut tree = serde_json::to_value(value).unwrap();
    *tree.pointer_mut(pointer).unwrap_or_else(|| panic!("no {pointer}")) = by;
    serde_json::from_value::<T>(tree).map(|_| ()).unwrap_err().to_string()
}

#[test]
fn what_an_identification_holds_comes_back() {
    let found = found();
    let reported = found.reported().unwrap();
    assert_eq!(reported.laws.verdict(), Some(DragVerdict::Law(DragLaw::Quadratic)));
    assert!((reported.alpha.value - 1.0).abs() < 4.0 * reported.alpha.spread.unwrap().std.max(1e-3), "{reported:?}");
    comes_back::<Identification>(&found);
    comes_back::<Conclusion>(&found.conclusion());
    comes_back::<Reported>(reported);
    comes_back::<Vec<Model>>(&found.models().to_vec());
    let relative = f64::INFINITY;
    comes_back::<Vec<Reason>>(&vec![
        Reason::TooWide { relative },
        Reason::Term(Term::Lag),
        Reason::NotSettled,
        Reason::SearchEnded { joining: true },
    ]);
    comes_back::<Choice>(found.fits().unwrap());
    comes_back::<RecordFit>(found.likeliest_fit().unwrap());
    comes_back::<Log>(&found.sources()[0].log);
    comes_back::<Record>(&found.sources()[0].log.record);
    comes_back::<RecordFeatures>(found.sources()[0].features.as_ref().unwrap());
    comes_back::<Features<f64>>(&found.sources()[0].features.as_ref().unwrap().features);
    comes_back::<Vec<Caution>>(&found.cautions().to_vec());
}

/// A record without steady cycles leaves the methods for mean cycles their reason, and the others their results; and one without
/// a delay given has it from the answer.
#[test]
fn methods_do_without_each_other() {
    let drifting = {
        let record = record(1.0);
        let from = record.samples() - 60;
        let part = |values: &[f64]| values[from..].to_vec();
        Record::new(part(record.time_s()), part(record.output()), part(record.input())).unwrap()
    };
    let any = Settings { any_input: true, ..Settings::default() };
    let found = Session::new(any).record("short", drifting).identify().unwrap();
    assert!(found.reported().is_some());
    let refused: Vec<_> = found.refused().iter().map(|one| (one.method.as_ref(), one.code.as_ref())).collect();
    assert_eq!(refused, [("iso", "no-cycle"), ("exact", "no-cycle")]);
    let exact = Settings { method: Method::Exact, ..Settings::default() };
    let found = Session::new(exact).record("log", record(1.0)).identify().unwrap();
    assert!(found.reported().is_none() && found.fits().is_none());
    assert!((found.models()[1].delay_s.value - 0.1).abs() < 0.01, "{:?}", found.models());
}

/// A delay that the record contradicts is said, whichever way it errs, and the answer has the right one.
#[test]
fn a_given_delay_is_checked_from_both_sides() {
    let sensor = Sensor { noise: 0.005, ..Sensor::default() };
    let experiment = SimulatedExperiment::new(axis(), relay(1.0), 10.0).unwrap().held().with_sensor(sensor).unwrap();
    let record = experiment.run(50.0).unwrap();
    let answer = |given_s| {
        let settings = Settings { method: Method::Fit, delay: Delay::KnownS(given_s), ..Settings::default() };
        Session::new(settings).record("log", record.clone()).identify().unwrap().reported().unwrap().clone()
    };
    let contradicted = |reason: &Reason| matches!(reason, Reason::DelayContradicted { .. });
    for given_s in [0.0, 0.2] {
        let reported = answer(given_s);
        assert!(reported.reasons.iter().any(contradicted), "{given_s}: {:?}", reported.reasons);
        assert_eq!(reported.trust, Trust::Widened);
        assert!((reported.mean_delay_s() - 0.1).abs() < 0.02, "{reported:?}");
    }
    assert!(!answer(0.1).reasons.iter().any(contradicted));
}

#[test]
fn what_the_methods_give_comes_back() {
    let features = RecordFeatures::of(&record(1.0)).unwrap();
    let oscillation = iso::Oscillation::of(&features.features, features.relay.level, 0.1);
    comes_back::<iso::Oscillation<f64>>(&oscillation);
    comes_back::<iso::Parameters<f64>>(&oscillation.identify().unwrap());
    let cycle = exact::MeanCycle::of(&features.features, features.relay.level, 0.1);
    comes_back::<exact::MeanCycle<f64>>(&cycle);
    comes_back::<DragAxis<f64>>(&cycle.quadratic_drag().unwrap());
    comes_back::<LimitCycle<f64>>(&limit_cycle(&axis(), &relay(1.0)).unwrap());
    let tuning = Tuning::new(&DragAxis::linear(1.0, 0.4).unwrap(), Structure::Pid, 2.0).unwrap();
    comes_back::<Tuning<f64>>(&tuning);
    comes_back::<Gains<f64>>(tuning.gains());
    for settings in
        [Settings::default(), Settings { drag: Some(DragLaw::Mixed), method: Method::Fit, ..Settings::default() }]
    {
        comes_back::<Settings>(&settings);
    }
    comes_back::<Columns>(&Columns::default());
    assert_eq!(serde_json::from_str::<Settings>("{}").unwrap(), Settings::default());
    assert!(serde_json::from_str::<Settings>(r#"{"dely": "estimated"}"#).is_err());
}

#[test]
fn a_joint_estimate_comes_back() {
    let rows: Vec<FeatureRow> = [1.0, 2.0, 4.0]
        .into_iter()
        .map(|level| {
            let LimitCycle { amplitude, bias, period_s, .. } = limit_cycle(&axis(), &relay(level)).unwrap();
            let (relay_level, switch_level, delay_s) = (level, 0.3, 0.1);
            let row = iso::Oscillation { relay_level, switch_level, amplitude, bias, period_s, delay_s };
            FeatureRow::new(&row).unwrap()
        })
        .collect();
    comes_back::<Joint>(&fit_rows(&rows, DragLaw::Quadratic, Delay::KnownS(0.1)).unwrap());
}

/// A ratio to an estimate of zero is infinite, and JSON has no number for it.
#[test]
fn infinite_ratios_come_back() {
    for ratio in [f64::INFINITY, f64::NEG_INFINITY, 2.5] {
        comes_back::<Warning>(&Warning::MethodsDisagree { parameter: AxisParameter::LinearDrag, ratio });
    }
    let text = serde_json::to_string(&Warning::IllConditioned { ratio: f64::NAN }).unwrap();
    let Warning::IllConditioned { ratio } = serde_json::from_str(&text).unwrap() else { panic!("{text}") };
    assert!(ratio.is_nan());
}

#[test]
fn what_does_not_belong_together_is_refused() {
    let found = found();
    let none = || serde_json::json!([]);
    assert!(damaged::<Record>(&record(1.0), "/input", none()).contains("must be as many"));
    assert!(damaged::<DragAxis<f64>>(&axis(), "/alpha", (-1.0).into()).contains("alpha"));
    assert!(damaged::<Identification>(&found, "/sources", none()).contains("does not belong"));
    assert!(damaged::<Identification>(&found, "/reported/deltas", none()).contains("one disturbance for each"));
    assert!(damaged::<Identification>(&found, "/models/0/record", 7.into()).contains("not there"));
    assert!(damaged::<Identification>(&found, "/fits/fits/0/records/0/first_sample", 9999.into()).contains("belong"));
    assert!(damaged::<Choice>(found.fits().unwrap(), "/fits", none()).contains("needs a fit"));
    assert!(damaged::<Model>(found.models().last().unwrap(), "/alpha/std", ().into()).contains("together"));
    let gains = Gains::new(Structure::Pd, 0.5, 0.0, 0.3, 0.02).unwrap();
    assert!(damaged::<Gains<f64>>(&gains, "/proportional", 0.into()).contains("proportional"));
}

#[test]
fn stages_are_told_in_order() {
    let stages = std::cell::RefCell::new(Vec::new());
    let session = Session::default().record("log", record(1.0));
    session.identify_with(|stage| stages.borrow_mut().push(stage)).unwrap();
    assert_eq!(*stages.borrow(), [Stage::Cycles, Stage::Fit, Stage::Terms]);
}

#[test]
fn settings_that_no_method_meets_are_refused() {
    let refused = |settings| Session::new(settings).record("log", record(1.0)).identify().unwrap_err();
    let mixed = Settings { method: Method::Iso, drag: Some(DragLaw::Mixed), ..Settings::default() };
    assert_eq!(refused(mixed), Refusal::Settings(SettingsError::MixedNeedsFit));
    for level in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refusal = refused(Settings { relay_level: Some(level), ..Settings::default() });
        assert!(refusal.is_usage() && refusal.code() == "out-of-domain", "{refusal}");
        comes_back::<RefusalDocument>(&RefusalDocument::from(&refusal));
    }
    assert!(Session::default().identify().is_err());
    assert!(Session::default().log("absent.csv").unwrap_err().is_usage());
}
