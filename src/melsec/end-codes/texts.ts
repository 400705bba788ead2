export { type Language, languages, type Texts } from '../../basics/texts'
