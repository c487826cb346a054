//! Finds motion and depth among the channels of a file.

use ::exr::meta::header::Header;
use fovqa_frame::{Guides, Motion, Plane};

use super::channels::{Channel, Channels, Match, NameForm};
use super::pixels::{Planes, Request};
use super::views::Views;
use super::window::Window;
use crate::error::{ReadErrorKind, listed};
use crate::guides::{
    ChannelSearch, DepthChannels, DepthChoice, Encoding, GuideFile, GuideOptions, GuidePreset,
    GuideSearch, LayerScope, MotionChannels, MotionChoice, joined_names,
};
use crate::note::Note;

/// The channels that were found.
#[derive(Debug, Default)]
pub(crate) struct GuideChannels {
    motion: MotionFound,
    depth: Option<Channel>,
    pub(crate) search: GuideSearch,
    notes: Vec<Note>,
}

/// The colour for which motion and depth are looked for.
#[derive(Debug)]
pub(crate) struct ColourContext<'a> {
    pub(crate) place: GuideFile,
    /// Full name of the colour's layer; empty if it has none.
    pub(crate) layer: &'a str,
    /// The view of the colour, in lower case.
    pub(crate) view: Option<String>,
    /// Full names of all colour layers.
    pub(crate) layers: &'a [String],
}

/// Looks for the motion and depth that are asked for.
pub(crate) fn find(
    headers: &[Header],
    views: &Views,
    options: &GuideOptions,
    beside: &ColourContext<'_>,
) -> Result<GuideChannels, ReadErrorKind> {
    if options.is_none() {
        return Ok(GuideChannels::default());
    }
    let channels = Channels::of(headers, views);
    let place = beside.place;
    let finder = Finder::new(&channels, views, beside);
    let (motions, depths) = (options.motion.choices(place), options.depth.choices(place));
    let (motion, motion_elsewhere) = finder.motion(&motions)?;
    let taken: &[Channel] = motion.as_ref().map_or(&[], |(pair, ..)| pair);
    let (depth, depth_elsewhere) = finder.depth(&depths, taken)?;
    let mut notes = Vec::new();
    for (what, elsewhere, is_auto) in [
        ("motion", &motion_elsewhere, options.motion == MotionChannels::Auto),
        ("depth", &depth_elsewhere, options.depth == DepthChannels::Auto),
    ] {
        if let Some(channels) = elsewhere.as_ref().filter(|_| is_auto) {
            notes.push(Note::GuidesElsewhere { what, channels: channels.clone() });
        }
    }
    match motion.as_ref().and_then(|(pair, _, preset)| Some((&pair[0], (*preset)?))) {
        Some((_, GuidePreset::Unreal)) => notes.push(Note::UnrealMotion),
        // Other renderers write R and G as well; only a name or a preset would make it certain.
        Some((x, GuidePreset::Falcor))
            if options.motion == MotionChannels::Auto && x.own.eq_ignore_ascii_case("R") =>
        {
            notes.push(Note::AssumedFalcor);
        }
        _ => {}
    }
    let found_motion = motion.as_ref().map(|(pair, ..)| joined_names(&pair.each_ref().map(name)));
    let found_depth = depth.as_ref().map(name);
    let search = GuideSearch {
        motion: ChannelSearch::motion(&motions).map(|sought| ChannelSearch {
            found: found_motion,
            elsewhere: motion_elsewhere,
            ..sought
        }),
        depth: ChannelSearch::depth(&depths).map(|sought| ChannelSearch {
            found: found_depth,
            elsewhere: depth_elsewhere,
            ..sought
        }),
        channels: channels.names().map(str::to_owned).collect(),
    };
    Ok(GuideChannels { motion, depth, search, notes })
}

fn name(channel: &Channel) -> String {
    channel.name.clone()
}

/// The channels that have the right names but belong to another view or layer than the colour, as
/// text.
type Elsewhere = Option<String>;

struct Finder<'a> {
    channels: &'a Channels,
    views: &'a Views,
    beside: &'a ColourContext<'a>,
    /// Full name of the colour's layer without its view.
    plain_layer: String,
    /// First components of the names of all colour layers, without views and in lower case.
    first_of_layers: Vec<String>,
    /// Whether the file has channels of several views.
    several_views: bool,
}

impl<'a> Finder<'a> {
    fn new(channels: &'a Channels, views: &'a Views, beside: &'a ColourContext<'a>) -> Self {
        Self {
            channels,
            views,
            beside,
            plain_layer: views.without(beside.layer),
            first_of_layers: beside.layers.iter().map(|l| first(&views.without(l))).collect(),
            several_views: channels.views().len() > 1,
        }
    }

    /// The first choice that exists.
    fn motion(&self, choices: &[MotionChoice]) -> Result<(MotionFound, Elsewhere), ReadErrorKind> {
        let mut elsewhere = None;
        for choice in choices {
            let matches = self.matching(&choice.channels, choice.scope, &[]);
            let search = Search { scope: choice.scope, what: "motion", names: &choice.channels };
            if let Some(found) = self.one_of(&matches, &search, &mut elsewhere)? {
                let pair = [found.channels[0].clone(), found.channels[1].clone()];
                return Ok((Some((pair, choice.encoding, choice.preset)), None));
            }
        }
        Ok((None, elsewhere))
    }

    /// The first choice that exists. A bare name does not match a channel in `taken`.
    fn depth(
        &self,
        choices: &[DepthChoice],
        taken: &[Channel],
    ) -> Result<(Option<Channel>, Elsewhere), ReadErrorKind> {
        let mut elsewhere = None;
        for choice in choices {
            let found = match choice {
                DepthChoice::Channel(name, scope) => {
                    let names = std::slice::from_ref(name);
                    let matches = self.matching(names, *scope, taken);
                    let search = Search { scope: *scope, what: "depth", names };
                    let found = self.one_of(&matches, &search, &mut elsewhere)?;
                    found.map(|found| found.channels[0].clone())
                }
                DepthChoice::Only => self.channels.only().cloned(),
            };
            if found.is_some() {
                return Ok((found, None));
            }
        }
        Ok((None, elsewhere))
    }

    fn matching<'b>(
        &'b self,
        names: &'b [String],
        scope: LayerScope,
        taken: &[Channel],
    ) -> Vec<Match<'b>> {
        let in_scope = |found: &Match<'_>| match scope {
            LayerScope::Named | LayerScope::Any => true,
            LayerScope::Own => self.is_own(found) && !taken.contains(found.channels[0]),
            LayerScope::OwnWithout(other) => {
                self.is_own(found)
                    && !taken.contains(found.channels[0])
                    && self.channels.beside(found, other).is_none()
            }
        };
        self.channels.matching(names).filter(in_scope).collect()
    }

    /// The name of the colour's layer in the form that a match uses.
    fn layer(&self, found: &Match<'_>) -> &str {
        match found.by {
            NameForm::Name => self.beside.layer,
            NameForm::Plain => &self.plain_layer,
        }
    }

    fn is_own(&self, found: &Match<'_>) -> bool {
        match self.beside.place {
            GuideFile::Separate => found.channels[0].bare,
            // The view is checked later.
            GuideFile::Colour => {
                lies_in(self.layer(found), found.lead)
                    || self.several_views && lies_in(&self.plain_layer, &self.plain_lead(found))
            }
        }
    }

    /// The prefix of the names of a match, without the view.
    fn plain_lead(&self, found: &Match<'_>) -> String {
        self.views.without(found.lead)
    }

    /// The only match of the colour's view, or the one nearest to the colour's layer. Channels of
    /// another view or layer are stored in `elsewhere`.
    fn one_of<'b>(
        &self,
        matches: &'b [Match<'b>],
        search: &Search<'_>,
        elsewhere: &mut Elsewhere,
    ) -> Result<Option<&'b Match<'b>>, ReadErrorKind> {
        // If the user gives a full name, it decides.
        let is_whole = |found: &&Match<'_>| found.by == NameForm::Name && found.lead.is_empty();
        if let Some(whole) =
            matches.iter().find(is_whole).filter(|_| search.scope == LayerScope::Named)
        {
            return Ok(Some(whole));
        }
        let view = self.beside.view.as_deref();
        let seen = matches.iter().filter(|found| !self.several_views || found.view() == view);
        let mut seen: Vec<&Match<'_>> = seen.collect();
        if seen.is_empty() && view.is_none() && matches.len() > 1 {
            seen = matches.iter().collect();
        }
        let found = match seen.as_slice() {
            [only] => Some(*only),
            several => self.nearest(several),
        };
        match found {
            Some(found) if self.is_of_another_layer(found, search.names) => {
                *elsewhere = Some(sets(&[found]));
                Ok(None)
            }
            Some(found) => Ok(Some(found)),
            None if !seen.is_empty() => {
                Err(ReadErrorKind::SeveralGuides { what: search.what, channels: sets(&seen) })
            }
            None => {
                if !matches.is_empty() {
                    let all: Vec<&Match<'_>> = matches.iter().collect();
                    *elsewhere = Some(sets(&all));
                }
                Ok(None)
            }
        }
    }

    /// The match whose layer has most components in common with the colour's, if it is the only
    /// one.
    fn nearest<'b>(&self, matches: &[&'b Match<'b>]) -> Option<&'b Match<'b>> {
        let near = |found: &Match<'_>| {
            let (lead, layer) = (self.plain_lead(found), components(&self.plain_layer));
            if layer.is_empty() {
                return usize::from(lead.is_empty());
            }
            let lead = components(&lead);
            lead.iter().zip(&layer).take_while(|(a, b)| a.eq_ignore_ascii_case(b)).count()
        };
        let most = matches.iter().map(|found| near(found)).max().filter(|most| *most > 0)?;
        let mut nearest = matches.iter().filter(|found| near(found) == most);
        nearest.next().filter(|_| nearest.next().is_none()).copied()
    }

    /// Whether a match belongs to another Blender view layer, or to the layer of another picture,
    /// whose name has the same first component.
    fn is_of_another_layer(&self, found: &Match<'_>, names: &[String]) -> bool {
        if let Some((own, colour)) = self.view_layer(found, names).zip(self.view_layer_of_colour())
        {
            return own != colour;
        }
        let (own, colour) = (first(&self.plain_lead(found)), first(&self.plain_layer));
        !own.is_empty() && own != colour && self.first_of_layers.contains(&own)
    }

    /// The Blender view layer of a colour layer `ViewLayer.Combined`, in lower case.
    fn view_layer_of_colour(&self) -> Option<String> {
        let layer = self.plain_layer.to_ascii_lowercase();
        let (view_layer, pass) = layer.rsplit_once('.')?;
        (pass == "combined").then(|| last(view_layer))
    }

    /// The Blender view layer of the pass `ViewLayer.Vector` or `ViewLayer.Depth`, in lower case. A
    /// part may have any name in front of it.
    fn view_layer(&self, found: &Match<'_>, names: &[String]) -> Option<String> {
        let name = names.first()?.to_ascii_lowercase();
        if !["vector.", "depth."].iter().any(|pass| name.starts_with(pass)) {
            return None;
        }
        let own = found.channels[0].own.to_ascii_lowercase();
        let view_layer = match own.strip_suffix(&name) {
            Some(view_layer) => last(view_layer.strip_suffix('.')?),
            // The name of the part holds the pass.
            None => last(&self.plain_lead(found)),
        };
        (!view_layer.is_empty()).then_some(view_layer)
    }
}

/// The channels to look for.
struct Search<'a> {
    scope: LayerScope,
    what: &'static str,
    names: &'a [String],
}

type MotionFound = Option<([Channel; 2], Encoding, Option<GuidePreset>)>;

/// Whether a layer is `lead` or lies in it.
fn lies_in(layer: &str, lead: &str) -> bool {
    let rest = layer.strip_prefix(lead);
    lead.is_empty() || rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

fn components(name: &str) -> Vec<&str> {
    name.split('.').filter(|part| !part.is_empty()).collect()
}

fn first(name: &str) -> String {
    name.split('.').next().unwrap_or_default().to_ascii_lowercase()
}

fn last(name: &str) -> String {
    name.rsplit('.').next().unwrap_or_default().to_ascii_lowercase()
}

/// The channels of matches as text.
fn sets(matches: &[&Match<'_>]) -> String {
    listed(matches.iter().map(|found| {
        let names: Vec<String> = found.channels.iter().map(|c| c.name.clone()).collect();
        joined_names(&names)
    }))
}

impl GuideChannels {
    /// The requests for the motion across, the motion down and the depth, as far as they exist. All
    /// of them must have the display window of the part `beside`.
    pub(crate) fn requests(
        &self,
        headers: &[Header],
        beside: &Header,
    ) -> Result<Vec<Request>, ReadErrorKind> {
        let display = |header: &Header| header.shared_attributes.display_window;
        let motion = self.motion.iter().flat_map(|(pair, ..)| pair);
        let requests = motion.chain(&self.depth).map(|channel| {
            let header = &headers[channel.part];
            if display(header) != display(beside) {
                return Err(ReadErrorKind::DisplayWindows);
            }
            let window = Window::of(header)?;
            Ok(Request { part: channel.part, channels: vec![channel.index], window })
        });
        requests.collect()
    }

    /// The motion and depth from the planes that were read for the requests, with notes about them.
    pub(crate) fn guides(
        &self,
        requests: &[Request],
        planes: impl IntoIterator<Item = Planes>,
    ) -> Result<(Guides, Vec<Note>), ReadErrorKind> {
        let mut planes =
            requests.iter().zip(planes).map(|(request, planes)| plane(planes, &request.window));
        let mut next = || planes.next().unwrap_or_else(|| unreachable!("a plane a request"));
        let motion = match &self.motion {
            Some((_, encoding, _)) => Some(motion(next()?, next()?, encoding)?),
            None => None,
        };
        let depth = self.depth.as_ref().map(|_| next()).transpose()?;
        let covered = requests.iter().all(|request| request.window.data_covers_display());
        let uncovered = (!covered).then_some(Note::UncoveredGuides);
        let notes = uncovered.into_iter().chain(self.notes.iter().cloned()).collect();
        Ok((Guides { motion, depth }, notes))
    }
}

fn plane(mut planes: Planes, window: &Window) -> Result<Plane, ReadErrorKind> {
    planes.blank(window.uncovered());
    let damaged = |detail| ReadErrorKind::Damaged { format: "OpenEXR", detail };
    Plane::new(window.display_width, window.display_height, planes.into_plane())
        .map_err(|error| damaged(error.to_string()))
}

fn motion(x: Plane, y: Plane, encoding: &Encoding) -> Result<Motion, ReadErrorKind> {
    let (width, height) = x.file_size();
    let motion = Motion::new(x, y, encoding.pixels([width, height]));
    // `Motion::new` fails only if the planes have different display windows.
    let motion = motion.ok_or(ReadErrorKind::DisplayWindows)?;
    Ok(motion.with_offset([encoding.offset; 2]))
}
